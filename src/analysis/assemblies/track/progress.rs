//! How far a search for all solutions has come.

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Generic solutions found.
    pub found: usize,
    /// Newton seeds tried.
    pub seeds: usize,
    /// Monodromy loops gone.
    pub loops: usize,
    /// Paths followed to the inputs asked, each as often as it was followed; 0 while searching.
    pub followed: usize,
}
