//! A surface of triangles.

use crate::pose::Point;
use crate::workspace::domain::Binding;
use crate::workspace::observer::StepCounter;
use crate::workspace::request::WorkspaceError;
use crate::workspace::vector::{cross, dot, length, minus, normal};

/// A closed surface of triangles that face outwards. An empty workspace has no triangles.
///
/// Every edge belongs to two triangles, which run along it in opposite directions. The triangles at a vertex form one
/// ring: where components of the workspace touch, each has its own vertices. An edge marks each change of the binding
/// slider or constraint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Positions of the vertices in the frame of the request's kind, mm.
    pub positions: Vec<Point>,
    /// Vertex numbers of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the constraint that bounds the workspace there.
    pub bindings: Vec<Binding>,
}

impl Surface {
    /// The volume that the surface encloses.
    ///
    /// # Units
    ///
    /// mm³.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface};
    ///
    /// let request = Request::new(Kind::Platform, 20.0);
    /// let volume = surface(&Machine::verne(), &request, &Unobserved)?.volume();
    /// assert!((volume - 2.336_92e8).abs() < 0.05 * volume, "{volume} at a tolerance of 20 mm");
    /// # Ok::<(), WorkspaceError>(())
    /// ```
    pub fn volume(&self) -> f64 {
        self.triangles.iter().map(|triangle| self.six_volumes(triangle)).sum::<f64>() / 6.0
    }

    /// A triangle's corners, mm.
    pub(in crate::workspace) fn corners(&self, triangle: &[u32; 3]) -> [Point; 3] {
        triangle.map(|corner| self.positions[corner as usize])
    }

    pub(in crate::workspace) fn area_of(&self, triangle: &[u32; 3]) -> f64 {
        0.5 * length(normal(self.corners(triangle)))
    }

    /// Six times the volume between a triangle and the first vertex.
    pub(in crate::workspace) fn six_volumes(&self, triangle: &[u32; 3]) -> f64 {
        let Some(&origin) = self.positions.first() else { return 0.0 };
        let [a, b, c] = self.corners(triangle).map(|corner| minus(corner, origin));
        dot(a, cross(b, c))
    }

    /// The least and the greatest coordinates; `None` if the surface is empty.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface};
    ///
    /// let request = Request::new(Kind::Platform, 20.0);
    /// let surface = surface(&Machine::verne(), &request, &Unobserved)?;
    /// let [low, high] = surface.bounds().expect("not empty");
    /// assert!(low[0] < 0.0 && high[0] > 0.0 && high[2] - low[2] < 757.0);
    /// # Ok::<(), WorkspaceError>(())
    /// ```
    pub fn bounds(&self) -> Option<[Point; 2]> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold([first; 2], |[least, greatest], position| {
            [
                [0, 1, 2].map(|i| f64::min(least[i], position[i])),
                [0, 1, 2].map(|i| f64::max(greatest[i], position[i])),
            ]
        }))
    }

    /// Removes the triangles that are not to be retained, and the vertices that no triangle uses.
    pub(super) fn retain(
        &mut self,
        retained: &[bool],
        steps: &mut StepCounter<'_>,
    ) -> Result<(), WorkspaceError> {
        let (triangles, bindings) = (&mut self.triangles, &mut self.bindings);
        let mut used = vec![false; self.positions.len()];
        let mut count = 0;
        for (number, _) in retained.iter().enumerate().filter(|(_, retained)| **retained) {
            steps.step()?;
            (triangles[count], bindings[count]) = (triangles[number], bindings[number]);
            for corner in triangles[count] {
                used[corner as usize] = true;
            }
            count += 1;
        }
        triangles.truncate(count);
        bindings.truncate(count);
        let mut numbers = Vec::with_capacity(used.len());
        let mut next = 0_u32;
        for (vertex, &used) in used.iter().enumerate() {
            steps.step()?;
            numbers.push(next);
            if used {
                self.positions[next as usize] = self.positions[vertex];
                next += 1;
            }
        }
        self.positions.truncate(next as usize);
        for triangle in triangles {
            steps.step()?;
            *triangle = triangle.map(|corner| numbers[corner as usize]);
        }
        Ok(())
    }
}
