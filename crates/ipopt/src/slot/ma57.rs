//! MA57 as Ipopt sees it. Which of its results Ipopt reads is in `righting_ipopt_sys::hsl`.

use super::Slot;
use crate::Factorization;
use righting_ipopt_sys::hsl::{SetMa57, ipfint};
use std::slice::{from_raw_parts, from_raw_parts_mut};

/// `info(1)` of a singular matrix.
const SINGULAR: ipfint = 4;
/// `info(1)` of an error that more memory does not help.
const FATAL: ipfint = -1;

/// Positions in `info`, from zero.
mod info {
    pub(super) const STATUS: usize = 0;
    pub(super) const LENGTH_OF_FACT: usize = 8;
    pub(super) const LENGTH_OF_IFACT: usize = 9;
    pub(super) const NEGATIVE_EIGENVALUES: usize = 23;
}

pub(super) fn install(set: SetMa57) {
    // SAFETY: the functions have the types that `set` declares, and live for ever.
    unsafe { set(Some(analyse), Some(factor), Some(solve), Some(enlarge), Some(defaults)) };
}

unsafe extern "C" fn defaults(cntl: *mut f64, icntl: *mut ipfint) {
    // SAFETY: MA57 documents 5 and 20 entries.
    unsafe {
        cntl.write_bytes(0, 5);
        icntl.write_bytes(0, 20);
    }
}

unsafe extern "C" fn analyse(
    n: *mut ipfint,
    ne: *mut ipfint,
    irn: *const ipfint,
    jcn: *const ipfint,
    _lkeep: *mut ipfint,
    _keep: *mut ipfint,
    _iwork: *mut ipfint,
    _icntl: *mut ipfint,
    info: *mut ipfint,
    _rinfo: *mut f64,
) {
    // SAFETY: `n` and `ne` point to numbers, `irn` and `jcn` to `ne` indices, `info` to 40.
    unsafe {
        let (rows, columns) = (slice(irn, *ne), slice(jcn, *ne));
        let order = length(*n);
        // Ipopt goes on whatever happens here, and is told when it asks for the factors.
        Slot::with_current(|slot| slot.analyse(order, rows, columns));
        *info.add(info::STATUS) = 0;
        *info.add(info::LENGTH_OF_FACT) = 1;
        *info.add(info::LENGTH_OF_IFACT) = 1;
    }
}

unsafe extern "C" fn factor(
    _n: *mut ipfint,
    ne: *mut ipfint,
    a: *mut f64,
    _fact: *mut f64,
    _lfact: *mut ipfint,
    _ifact: *mut ipfint,
    _lifact: *mut ipfint,
    _lkeep: *mut ipfint,
    _keep: *mut ipfint,
    _iwork: *mut ipfint,
    _icntl: *mut ipfint,
    cntl: *mut f64,
    info: *mut ipfint,
    _rinfo: *mut f64,
) {
    // SAFETY: `ne` points to a number, `a` to `ne` values, `cntl` to 5, `info` to 40 entries.
    unsafe {
        let (values, tolerance) = (slice(a, *ne), *cntl);
        let outcome = Slot::with_current(|slot| slot.factor(values, tolerance));
        let (status, negative) = match outcome.unwrap_or(Factorization::Failed) {
            Factorization::Regular { negative_eigenvalues } => (0, negative_eigenvalues),
            Factorization::Singular => (SINGULAR, 0),
            Factorization::Failed => (FATAL, 0),
        };
        *info.add(info::STATUS) = status;
        *info.add(info::NEGATIVE_EIGENVALUES) = ipfint::try_from(negative).unwrap_or(ipfint::MAX);
    }
}

unsafe extern "C" fn solve(
    _job: *mut ipfint,
    n: *mut ipfint,
    _fact: *mut f64,
    _lfact: *mut ipfint,
    _ifact: *mut ipfint,
    _lifact: *mut ipfint,
    nrhs: *mut ipfint,
    rhs: *mut f64,
    lrhs: *mut ipfint,
    _work: *mut f64,
    _lwork: *mut ipfint,
    _iwork: *mut ipfint,
    _icntl: *mut ipfint,
    info: *mut ipfint,
) {
    // SAFETY: `n`, `nrhs` and `lrhs` point to numbers, `info` to 40, and `rhs` to `nrhs` columns of
    // `n` values that start `lrhs` apart.
    unsafe {
        let (order, count, stride) = (length(*n), length(*nrhs), length(*lrhs));
        let solve = |column: usize, columns: usize| {
            let values = from_raw_parts_mut(rhs.add(column * stride), order * columns);
            Slot::with_current(|slot| slot.solve(values));
        };
        if stride == order {
            solve(0, count);
        } else {
            (0..count).for_each(|column| solve(column, 1));
        }
        *info.add(info::STATUS) = 0;
    }
}

/// Ipopt calls this only after a factorisation that asked for more memory, which none here does.
unsafe extern "C" fn enlarge(
    _n: *mut ipfint,
    _ic: *mut ipfint,
    _keep: *mut ipfint,
    _fact: *mut f64,
    _lfact: *mut ipfint,
    _newfac: *mut f64,
    _lnew: *mut ipfint,
    _ifact: *mut ipfint,
    _lifact: *mut ipfint,
    _newifc: *mut ipfint,
    _linew: *mut ipfint,
    info: *mut ipfint,
) {
    // SAFETY: `info` points to 40 entries.
    unsafe { *info.add(info::STATUS) = FATAL };
}

fn length(count: ipfint) -> usize {
    usize::try_from(count).unwrap_or(0)
}

/// # Safety
/// `pointer` must be valid for `count` reads as long as the subroutine runs.
unsafe fn slice<'a, T>(pointer: *const T, count: ipfint) -> &'a [T] {
    if count <= 0 {
        return &[];
    }
    // SAFETY: the caller's promise.
    unsafe { from_raw_parts(pointer, length(count)) }
}
