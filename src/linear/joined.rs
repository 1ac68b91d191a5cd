//! Which of many things are connected with one another, as some of them are joined (Galler and Fischer 1964).

/// The first of all that are connected with one.
pub(crate) fn root(roots: &mut [usize], mut of: usize) -> usize {
    while roots[of] != of {
        roots[of] = roots[roots[of]];
        of = roots[of];
    }
    of
}

/// Connects two and all that is connected with them.
pub(crate) fn join(roots: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(roots, a), root(roots, b));
    roots[a.max(b)] = a.min(b);
}
