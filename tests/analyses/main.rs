//! The other analyses, each against closed forms and published values.

mod closed_reports;
mod closing;
mod comparison;
mod conversion;
mod formulas;
mod cylinders;
mod frames;
mod gimbal_lock;
mod mobility;
mod modes;
mod reports;
mod singularities;
mod rank;
mod statics;
mod sweep;
mod velocity;
mod watched;
mod workspace;
