//! Sine and cosine that round the same in every lane width.
//!
//! The argument is reduced to [−π/4, π/4] by Cody and Waite's method with π/2 in three parts whose
//! products with the quadrant number are exact, then the minimax polynomials of fdlibm's kernels
//! (Sun Microsystems, 1993) are evaluated with the reduction's tail. Nothing branches, so the same
//! source vectorises for any instruction set and, with no fused multiply-add, gives the same bits.
//! Beyond [`REDUCTION_LIMIT`] the standard library takes over, lane by lane.

/// The largest magnitude, in radians, that the three-part reduction serves.
pub(crate) const REDUCTION_LIMIT: f64 = 1.0e5;

/// Adding it rounds to the nearest integer and leaves that integer in the low bits.
const ROUND_TO_INTEGER: f64 = 6_755_399_441_055_744.0;

const PIO2_1: f64 = f64::from_bits(0x3FF9_21FB_5440_0000);
const PIO2_2: f64 = f64::from_bits(0x3DD0_B461_1A60_0000);
const PIO2_2_TAIL: f64 = f64::from_bits(0x3BA3_198A_2E03_7073);

const SIN: [f64; 6] = [
    f64::from_bits(0xBFC5_5555_5555_5549),
    f64::from_bits(0x3F81_1111_1110_F8A6),
    f64::from_bits(0xBF2A_01A0_19C1_61D5),
    f64::from_bits(0x3EC7_1DE3_57B1_FE7D),
    f64::from_bits(0xBE5A_E5E6_8A2B_9CEB),
    f64::from_bits(0x3DE5_D93A_5ACF_D57C),
];
const COS: [f64; 6] = [
    f64::from_bits(0x3FA5_5555_5555_554C),
    f64::from_bits(0xBF56_C16C_16C1_5177),
    f64::from_bits(0x3EFA_01A0_19CB_1590),
    f64::from_bits(0xBE92_7E4F_809C_52AD),
    f64::from_bits(0x3E21_EE9E_BDB4_B1C4),
    f64::from_bits(0xBDA8_FAE9_BE88_38D4),
];

/// (sin x, cos x) for |x| ≤ [`REDUCTION_LIMIT`]; anything at all beyond.
#[inline(always)]
pub(crate) fn sin_cos_reduced(x: f64) -> (f64, f64) {
    let shifted = x * std::f64::consts::FRAC_2_PI + ROUND_TO_INTEGER;
    let n = shifted - ROUND_TO_INTEGER;
    let quadrant = shifted.to_bits();

    // x − n π/2 as an unevaluated sum y + tail.
    let r = x - n * PIO2_1;
    let w = n * PIO2_2;
    let t = r - w;
    let virtual_w = r - t;
    let lost = (r - (t + virtual_w)) + (virtual_w - w);
    let w = n * PIO2_2_TAIL - lost;
    let y = t - w;
    let tail = (t - y) - w;

    let z = y * y;
    let v = z * y;
    let p = SIN[1] + z * (SIN[2] + z * (SIN[3] + z * (SIN[4] + z * SIN[5])));
    let sine = y - ((z * (0.5 * tail - v * p) - tail) - v * SIN[0]);

    let q = z * (COS[0] + z * (COS[1] + z * (COS[2] + z * (COS[3] + z * (COS[4] + z * COS[5])))));
    let half = 0.5 * z;
    let one_less = 1.0 - half;
    let cosine = one_less + (((1.0 - one_less) - half) + (z * q - y * tail));

    // An odd quadrant swaps the two; the next bit of (quadrant, quadrant + 1) gives the signs.
    let odd = (quadrant & 1).wrapping_neg();
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let sine_sign = (quadrant & 2) << 62;
    let cosine_sign = (quadrant.wrapping_add(1) & 2) << 62;
    (
        f64::from_bits(((cosine & odd) | (sine & !odd)) ^ sine_sign),
        f64::from_bits(((sine & odd) | (cosine & !odd)) ^ cosine_sign),
    )
}

/// The sine of `x` radians.
pub(crate) fn sin(x: f64) -> f64 {
    if x.abs() <= REDUCTION_LIMIT { sin_cos_reduced(x).0 } else { x.sin() }
}

/// The cosine of `x` radians.
pub(crate) fn cos(x: f64) -> f64 {
    if x.abs() <= REDUCTION_LIMIT { sin_cos_reduced(x).1 } else { x.cos() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units of the last place of the reference.
    fn ulps(value: f64, reference: f64) -> f64 {
        let ulp = reference.abs().next_up() - reference.abs();
        (value - reference).abs() / ulp
    }

    #[test]
    fn within_one_ulp_of_the_standard_library() {
        // A Weyl sequence over several magnitudes, and the neighbourhoods of multiples of π/2.
        let mut phase = 0.0_f64;
        let mut worst = 0.0_f64;
        for i in 0..2_000_000_u32 {
            phase = (phase + 0.618_033_988_749_894_9).fract();
            let scale = [1.0, 10.0, 1.0e3, REDUCTION_LIMIT][(i % 4) as usize];
            let x = (2.0 * phase - 1.0) * scale;
            worst = worst.max(ulps(sin(x), x.sin())).max(ulps(cos(x), x.cos()));
        }
        for k in -63_000..63_000_i32 {
            let near = f64::from(k) * std::f64::consts::FRAC_PI_2;
            for x in [near, near.next_up(), near.next_down()] {
                worst = worst.max(ulps(sin(x), x.sin())).max(ulps(cos(x), x.cos()));
            }
        }
        assert!(worst <= 1.0, "{worst} ulp");
    }

    #[test]
    fn special_values() {
        assert_eq!((sin(0.0), cos(0.0)), (0.0, 1.0));
        assert!(sin(f64::NAN).is_nan() && cos(f64::INFINITY).is_nan());
        assert_eq!(sin(1.0e300), 1.0e300_f64.sin());
        assert_eq!(cos(-2.0e5), (-2.0e5_f64).cos());
        assert_eq!(sin(-1.0e-310), -1.0e-310);
    }
}
