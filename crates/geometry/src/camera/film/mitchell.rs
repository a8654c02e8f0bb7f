//! Mitchell & Netravali's cubic filter with B = C = 1/3, along one axis.

/// Where it ends, in pixels.
pub(super) const HALF_WIDTH: f64 = 2.0;
/// Where it becomes negative.
const ROOT: f64 = 8.0 / 7.0;

/// The filter at a distance from its middle.
pub(super) fn value(x: f64) -> f64 {
    if x < 1.0 {
        (16.0 / 3.0 + x * x * (-12.0 + 7.0 * x)) / 6.0
    } else if x < HALF_WIDTH {
        (32.0 / 3.0 + x * (-20.0 + x * (12.0 - x * 7.0 / 3.0))) / 6.0
    } else {
        0.0
    }
}

/// The integral of the filter from its middle to `x` in [0, 2]; all of it is 1/2.
fn integral(x: f64) -> f64 {
    if x < 1.0 {
        x * (16.0 / 3.0 + x * x * (-4.0 + x * 7.0 / 4.0)) / 6.0
    } else {
        let far = x * (32.0 / 3.0 + x * (-10.0 + x * (4.0 - x * 7.0 / 12.0)));
        // The pieces meet at 1.
        (far - 1.0) / 6.0
    }
}

/// The same of its absolute value.
fn absolute_integral(x: f64) -> f64 {
    if x < ROOT {
        integral(x)
    } else {
        2.0 * integral(ROOT) - integral(x)
    }
}

/// A uniform number in [0, 1) to a place with the density of the filter's absolute value, and how
/// often it counts.
pub(super) fn sample(uniform: f64) -> (f64, f64) {
    let all = absolute_integral(HALF_WIDTH);
    let wanted = (2.0 * uniform - 1.0).abs() * all;
    let (mut low, mut high) = (0.0, HALF_WIDTH);
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        if absolute_integral(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    let side = if uniform < 0.5 { -1.0 } else { 1.0 };
    let sign = if low < ROOT { 1.0 } else { -1.0 };
    (side * low, sign * 2.0 * all)
}
