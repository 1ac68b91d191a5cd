//! The other analyses, each against closed forms and published values.

mod closed_reports;
mod closing;
mod comparison;
mod conversion;
mod cusps;
mod cylinders;
mod formulas;
mod frames;
mod gimbal_lock;
mod lengths;
mod mobility;
mod modes;
mod quantities;
mod rank;
mod reports;
mod singularities;
mod spins;
mod statics;
mod suspension;
mod sweep;
mod told;
mod velocity;
mod watched;
mod workspace;
