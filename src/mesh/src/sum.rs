//! Sums of many terms.

/// The sum with Neumaier's compensation. It is as exact as one rounding of the true sum, unless the terms nearly
/// cancel.
pub(crate) fn compensated(terms: impl Iterator<Item = f64>) -> f64 {
    let (sum, lost) = terms.fold((0.0, 0.0), |(sum, lost): (f64, f64), term| {
        let next = sum + term;
        let rounding = if sum.abs() >= term.abs() { (sum - next) + term } else { (term - next) + sum };
        (next, lost + rounding)
    });
    sum + lost
}

#[cfg(test)]
mod tests {
    use super::compensated;

    #[test]
    fn compensation_recovers_what_a_plain_sum_loses() {
        assert_eq!(compensated([1.0, 1e100, 1.0, -1e100].into_iter()), 2.0);
        assert_eq!(compensated(std::iter::empty()), 0.0);
    }
}
