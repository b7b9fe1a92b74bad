//! Rectangles in the plane of an atlas.

/// A rectangle with sides along u and v, in units of the longest dimension.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
}

impl Rectangle {
    /// The rectangle with a margin on all sides.
    pub(super) fn with_margin(&self, margin: f64) -> Self {
        Self { low: self.low.map(|low| low - margin), high: self.high.map(|high| high + margin) }
    }

    /// The rectangle turned by half a turn about the origin.
    pub(super) fn mirrored(&self) -> Self {
        Self { low: self.high.map(|high| -high), high: self.low.map(|low| -low) }
    }

    pub(super) fn side(&self) -> f64 {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1])
    }

    /// The distance from the nearest side; negative outside.
    pub(super) fn reserve(&self, at: [f64; 2]) -> f64 {
        (0..2).map(|i| (at[i] - self.low[i]).min(self.high[i] - at[i])).fold(f64::INFINITY, f64::min)
    }

    pub(super) fn contains(&self, at: [f64; 2]) -> bool {
        self.reserve(at) >= 0.0
    }

    /// Whether a curve between two points that is not much longer than its chord may meet the rectangle.
    pub(super) fn may_meet(&self, [a, b]: [[f64; 2]; 2]) -> bool {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        (0..2).all(|i| a[i].max(b[i]) + length >= self.low[i] && a[i].min(b[i]) - length <= self.high[i])
    }

    /// The nearest point of the rectangle.
    pub(super) fn clamped(&self, at: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|i| at[i].clamp(self.low[i], self.high[i]))
    }
}
