//! Independent pieces of work on all cores or one after another, with the same results in the same
//! order.

/// `f(storage, i)` for `i` below `count`; storage is cloned for each thread and must not carry
/// anything from one piece to the next.
#[cfg(feature = "parallel")]
pub fn each<S, R>(count: usize, storage: &S, f: impl Fn(&mut S, usize) -> R + Sync) -> Vec<R>
where
    S: Clone + Send + Sync,
    R: Send,
{
    use rayon::prelude::*;
    if count < 2 {
        return (0..count).map(|i| f(&mut storage.clone(), i)).collect();
    }
    let pieces = (0..count).into_par_iter();
    pieces
        .map_init(|| storage.clone(), |storage, i| f(storage, i))
        .collect()
}

/// `f(storage, i)` for `i` below `count`, one after another.
#[cfg(not(feature = "parallel"))]
pub fn each<S: Clone, R>(count: usize, storage: &S, f: impl Fn(&mut S, usize) -> R) -> Vec<R> {
    let mut storage = storage.clone();
    (0..count).map(|i| f(&mut storage, i)).collect()
}
