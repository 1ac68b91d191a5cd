//! What is said of questions that have no answer as they are posed, with the options that would put them right.

pub mod load;
pub mod loci;
pub mod map;
pub mod motion;
pub mod question;
