//! A path: points joined by straight segments.

mod colour_scale;

pub use self::colour_scale::ColourScale;
use crate::{Bounds, MeshError, Swatch};

/// How the segment that ends at a point is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stroke {
    /// In the colours of the values of its ends.
    Coloured,
    /// In the path's plain colour.
    Plain,
    /// Not at all: the path begins anew at the point.
    None,
}

/// Points in millimetres, joined by straight segments.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    points: Vec<[f64; 3]>,
    values: Vec<f64>,
    strokes: Vec<Stroke>,
    points_per_vertex: u64,
    /// The name of the coloured segments.
    pub coloured: String,
    /// The name and the colour of the plain segments.
    pub plain: Swatch,
    /// The colours of the values.
    pub scale: ColourScale,
}

impl Path {
    /// The points that are drawn, mm.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The least value at the points that each drawn point stands for.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// How the segment that ends at each point is drawn. The first point ends none.
    pub fn strokes(&self) -> &[Stroke] {
        &self.strokes
    }

    /// The number of points that one drawn point stands for: 1 if all are drawn.
    pub fn points_per_vertex(&self) -> u64 {
        self.points_per_vertex
    }

    /// The smallest box along the axes that contains the points; `None` without points.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        let (first, rest) = self.points.split_first()?;
        let both = |bounds: Bounds, point: &[f64; 3]| Bounds {
            min: std::array::from_fn(|axis| bounds.min[axis].min(point[axis])),
            max: std::array::from_fn(|axis| bounds.max[axis].max(point[axis])),
        };
        Some(rest.iter().fold(Bounds { min: *first, max: *first }, both))
    }
}

/// Takes the points of a path one by one, and keeps so many of them as are allowed: each n-th.
///
/// A segment between kept points is coloured if one of the segments that it stands for is; a point has the least value
/// of the points that it stands for. So a coloured stretch and a small value never disappear.
#[derive(Clone, Debug)]
pub struct PathBuilder {
    every: u64,
    count: u64,
    points: Vec<[f64; 3]>,
    values: Vec<f64>,
    strokes: Vec<Stroke>,
    /// A summary of the points since the last kept one: the last of them, the least value, and the strongest stroke.
    pending: Option<([f64; 3], f64, Stroke)>,
}

impl PathBuilder {
    /// A builder for about `expected` points that keeps at most `most` of them, and the last one.
    ///
    /// ```
    /// use verne_mesh::{ColourScale, PathBuilder, Stroke, Swatch};
    ///
    /// let mut builder = PathBuilder::new(5, 3);
    /// for (x, value) in [(0.0, 0.9), (1.0, 0.1), (2.0, 0.8), (3.0, 0.7), (4.0, 0.6)] {
    ///     builder.push([x, 0.0, 0.0], value, Stroke::Coloured)?;
    /// }
    /// let plain = Swatch { name: "rapid".to_owned(), rgb: [128; 3] };
    /// let path = builder.finish("feed".to_owned(), plain, ColourScale { least: 0.0, greatest: 1.0 });
    /// assert_eq!(path.points(), [[0.0; 3], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0]]);
    /// assert_eq!((path.values(), path.points_per_vertex()), (&[0.9, 0.1, 0.6][..], 2));
    /// # Ok::<(), verne_mesh::MeshError>(())
    /// ```
    pub fn new(expected: u64, most: u64) -> Self {
        let every = expected.div_ceil(most.max(1)).max(1);
        Self { every, count: 0, points: Vec::new(), values: Vec::new(), strokes: Vec::new(), pending: None }
    }

    /// Adds a point with its value, and how the segment that leads to it is drawn.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`]: a coordinate or the value is infinite or NaN.
    pub fn push(&mut self, point: [f64; 3], value: f64, stroke: Stroke) -> Result<(), MeshError> {
        if !(value.is_finite() && point.iter().all(|coordinate| coordinate.is_finite())) {
            return Err(MeshError::NotFinite { vertex: self.points.len() });
        }
        let (value, stroke) = match self.pending {
            Some((_, least, strongest)) => (value.min(least), stroke.min(strongest)),
            None => (value, stroke),
        };
        self.pending = Some((point, value, stroke));
        if self.count.is_multiple_of(self.every) {
            self.keep();
        }
        self.count += 1;
        Ok(())
    }

    /// The path. Its segments have the name `coloured` or that of `plain`.
    pub fn finish(mut self, coloured: String, plain: Swatch, scale: ColourScale) -> Path {
        self.keep();
        let Self { every, points, values, mut strokes, .. } = self;
        if let Some(first) = strokes.first_mut() {
            *first = Stroke::None;
        }
        Path { points, values, strokes, points_per_vertex: every, coloured, plain, scale }
    }

    fn keep(&mut self) {
        if let Some((point, value, stroke)) = self.pending.take() {
            self.points.push(point);
            self.values.push(value);
            self.strokes.push(stroke);
        }
    }
}
