//! Work compiled for the vector registers of several processors.

/// Runs work in the widest vector registers of the processor, chosen at run time. The bits are the same in all of them,
/// as no instruction that rounds once where others round twice is used.
///
/// What `work` calls must be inlined into it, or it is compiled for the narrowest registers.
#[inline]
pub fn widest<R>(work: impl FnOnce() -> R) -> R {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
        fn avx512<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        #[target_feature(enable = "avx2")]
        fn avx2<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        // SAFETY: the processor has the instructions that each of the two is compiled to
        #[allow(unsafe_code)]
        unsafe {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                return avx512(work);
            }
            if is_x86_feature_detected!("avx2") {
                return avx2(work);
            }
        }
    }
    work()
}
