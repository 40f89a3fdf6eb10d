//! A case in letters: the triangle in its own plane, where its line meets the plane, and where a kernel says so.

use super::scene::{FloatLayer, MapScene};
use crate::arith::Real;
use crate::audit::Row;
use crate::case::Case;
use crate::kernel::{Gives, Scalar, Verdict, verdicts_of};
use crate::oracle;

/// The most columns and rows. A letter is about twice as high as wide.
const WIDE: f64 = 44.0;
const HIGH: f64 = 7.0;

/// A triangle of fewer rows or columns is a line.
const LEAST: f64 = 2.5;

/// A point that is farther from the first vertex, in longest edges, is left out with the whole sketch: the triangle would be a dot.
const FAR: f64 = 2.5;

/// The sketch of a case; with one row also where its hit is, if that can be seen to be elsewhere. None where letters show
/// nothing: the line is parallel to the plane, the triangle is too thin, or it is met far away.
pub fn sketch<F: Scalar>(case: &Case<F>, row: Option<&Row>) -> Option<String> {
    let is_finite = case.vectors().iter().flatten().all(Real::is_finite);
    let definition = oracle::define(case);
    if !is_finite || definition.exact.t.is_none() {
        return None;
    }
    let miss = (Gives::NOTHING, Verdict::miss(None));
    let (gives, verdict) = row.and_then(|row| answer(case, row)).unwrap_or(miss);
    let scene = MapScene::new(case, gives, &verdict, &definition);
    let layer = scene.from(&scene.triangle.a);
    Canvas::new(&layer)?.drawn(&layer)
}

fn answer<F: Scalar>(case: &Case<F>, row: &Row) -> Option<(Gives, Verdict<F>)> {
    let subject = F::subject(row.entry)?;
    let mut verdicts = [Verdict::miss(None)];
    verdicts_of(subject, &[*case], &row.epsilons::<F>(), &mut verdicts);
    let [verdict] = verdicts;
    Some((row.entry.info.gives, verdict))
}

/// Letters, row by row from the top, and how points of the plane lie on them.
struct Canvas {
    letters: Vec<Vec<char>>,
    low: [f64; 2],
    /// Rows to a unit; there are twice as many columns.
    scale: f64,
}

impl Canvas {
    /// A canvas for the triangle and the points at it; none if letters would show nothing.
    fn new(layer: &FloatLayer) -> Option<Canvas> {
        let exact = layer.exact?;
        let mut points = layer.vertices.to_vec();
        let of_triangle = size(&points);
        points.push(exact);
        points.extend(layer.computed.filter(is_near));
        let all = size(&points);
        if !layer.has_area || !is_near(&exact) || !all.iter().all(|side| side.is_finite()) {
            return None;
        }
        let scale = (WIDE / 2.0 / all[0]).min(HIGH / all[1]);
        let is_seen = LEAST <= of_triangle[0] * scale * 2.0 && LEAST <= of_triangle[1] * scale;
        let low = [0, 1].map(|axis| {
            points
                .iter()
                .map(|point| point[axis])
                .fold(f64::MAX, f64::min)
        });
        let columns = (all[0] * scale * 2.0).round() as usize + 1;
        let rows = (all[1] * scale).round() as usize + 1;
        is_seen.then(|| Canvas {
            letters: vec![vec![' '; columns]; rows],
            low,
            scale,
        })
    }

    /// The column and the row of a point.
    fn place(&self, [x, y]: [f64; 2]) -> [usize; 2] {
        let column = ((x - self.low[0]) * self.scale * 2.0).round() as usize;
        let above = ((y - self.low[1]) * self.scale).round() as usize;
        [column, (self.letters.len() - 1).saturating_sub(above)]
    }

    fn put(&mut self, point: [f64; 2], letter: char) {
        let [column, row] = self.place(point);
        if let Some(place) = self
            .letters
            .get_mut(row)
            .and_then(|row| row.get_mut(column))
        {
            *place = letter;
        }
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        const STEPS: usize = 200;
        for step in 0..=STEPS {
            let share = step as f64 / STEPS as f64;
            let point = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
            self.put(point, '.');
        }
    }

    /// The sketch with its key.
    fn drawn(mut self, layer: &FloatLayer) -> Option<String> {
        let [a, b, c] = layer.vertices;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            self.line(from, to);
        }
        for (vertex, name) in layer.vertices.into_iter().zip(['a', 'b', 'c']) {
            self.put(vertex, name);
        }
        let exact = layer.exact?;
        let elsewhere = layer
            .computed
            .filter(|point| is_near(point) && self.place(*point) != self.place(exact));
        self.put(exact, 'x');
        let mut key = "x: where the line meets the plane".to_owned();
        if let Some(point) = elsewhere {
            self.put(point, 'o');
            key += "; o: where the kernel says";
        }
        let lines = self.letters.iter().map(|row| {
            let line: String = row.iter().collect();
            line.trim_end().to_owned()
        });
        let lines: Vec<String> = lines.chain([key]).collect();
        Some(lines.join("\n"))
    }
}

fn is_near(point: &[f64; 2]) -> bool {
    point.iter().all(|x| x.abs() < FAR)
}

/// How wide and how high some points lie.
fn size(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let of_axis = || points.iter().map(|point| point[axis]);
        of_axis().fold(f64::MIN, f64::max) - of_axis().fold(f64::MAX, f64::min)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sketch_of(target: [f64; 3], triangle: [[f64; 3]; 3]) -> Option<String> {
        let [x, y, _] = target;
        sketch(
            &Case::<f64>::new([x, y, 1.0], [0.0, 0.0, -1.0], triangle),
            None,
        )
    }

    const TRIANGLE: [[f64; 3]; 3] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

    #[test]
    fn a_hit_inside_and_one_beside_stand_where_they_are() {
        let inside = sketch_of([1.0, 1.0, 0.0], TRIANGLE).unwrap();
        let lines: Vec<&str> = inside.lines().collect();
        let row_of = |letter: char| lines.iter().position(|line| line.contains(letter)).unwrap();
        // The longest edge, from b to c, lies level: a is above or below it, and x between them.
        assert_eq!(row_of('b'), row_of('c'));
        let rows = [row_of('a'), row_of('x'), row_of('b')];
        assert!(
            rows.is_sorted() || rows.iter().rev().is_sorted(),
            "{inside}"
        );
        let beside = sketch_of([-1.0, -1.0, 0.0], TRIANGLE).unwrap();
        let lines: Vec<&str> = beside.lines().collect();
        let row_of = |letter: char| lines.iter().position(|line| line.contains(letter)).unwrap();
        let rows = [row_of('x'), row_of('a'), row_of('b')];
        assert!(
            rows.is_sorted() || rows.iter().rev().is_sorted(),
            "{beside}"
        );
        assert!(lines.iter().all(|line| line.len() <= 46), "{beside}");
    }

    #[test]
    fn where_letters_show_nothing_there_is_none() {
        for (target, triangle) in [
            ([99.0, 0.0, 0.0], TRIANGLE),
            (
                [1.0, 0.0, 0.0],
                [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 1e-6, 0.0]],
            ),
            (
                [1.0, 0.0, 0.0],
                [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
            ),
            (
                [1.0, 0.0, 0.0],
                [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 0.0, 3.0]],
            ),
            ([f64::NAN, 0.0, 0.0], TRIANGLE),
        ] {
            assert_eq!(sketch_of(target, triangle), None, "{target:?}");
        }
    }
}
