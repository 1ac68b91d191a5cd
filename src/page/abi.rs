//! Call interface of a page: it puts a request in UTF-8 at [`room`], and reads the reply at [`reply`].
//!
//! No pointer is followed here. The attributes alone count as unsafe: an exported name must be the only one of its kind
//! in the module, and nothing else is exported from it.
#![allow(unsafe_code)]

use std::cell::RefCell;

use super::Page;

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
    static REQUEST: RefCell<Vec<u8>> = RefCell::default();
    static REPLY: RefCell<String> = RefCell::default();
}

/// The address of room for a request of `bytes` bytes.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        request.clear();
        request.resize(bytes, 0);
        request.as_mut_ptr()
    })
}

/// Answers the request; the number of bytes of the reply.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let request = REQUEST.take();
    let reply = PAGE.with_borrow_mut(|page| page.answer(&String::from_utf8_lossy(&request)));
    let bytes = reply.len();
    REPLY.set(reply);
    bytes
}

/// The address of the last reply.
#[unsafe(no_mangle)]
pub extern "C" fn reply() -> *const u8 {
    REPLY.with_borrow(|reply| reply.as_ptr())
}
