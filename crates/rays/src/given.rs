//! The scene that a program makes of mesh and rays before it computes, as its user says: moved, scaled, and then rounded.

use crate::arith::{Float, ScalarName};
use crate::asked::Asked;
use crate::files::mesh::Mesh;
use crate::files::number;
use crate::kernel::Scalar;
use crate::result::GivenScene;
use hairline_scene::Ray;

/// The steps by which a program makes its scene, from left to right: `move=-5,0,2 scale=0.001`.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenSteps {
    text: String,
    steps: Vec<Step>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    /// This is added to each point.
    Move([f64; 3]),
    /// Each coordinate is multiplied by this.
    Scale(f64),
}

/// The form of the steps, for messages.
const FORM: &str = "expected steps as \"move=-5,0,2 scale=0.001\", in the order of the program";

impl GivenSteps {
    /// The steps of a text; an error says what is expected.
    pub fn of(text: &str) -> Result<GivenSteps, String> {
        let steps: Result<Vec<Step>, String> = text.split_whitespace().map(Step::of).collect();
        let steps = steps?;
        let given = GivenSteps {
            text: text.split_whitespace().collect::<Vec<_>>().join(" "),
            steps,
        };
        match (given.steps.is_empty(), given.scale().is_normal()) {
            (true, _) => Err(FORM.to_owned()),
            (false, true) => Ok(given),
            (false, false) => Err("the scales multiply to a number beyond f64".to_owned()),
        }
    }

    /// The scene that they make if they are computed in a scalar.
    pub fn scene(&self, computed_in: ScalarName) -> GivenScene {
        GivenScene {
            steps: self.text.clone(),
            scale: self.scale(),
            computed_in,
            has_written_t: false,
        }
    }

    /// How many times as large as the written scene the program's is.
    fn scale(&self) -> f64 {
        let scale = |step: &Step| match step {
            Step::Move(_) => 1.0,
            Step::Scale(scale) => *scale,
        };
        self.steps.iter().map(scale).product()
    }

    /// A point after the steps, each rounded in `G`.
    fn moved<G: Float>(&self, point: [G; 3]) -> [G; 3] {
        let moved = |point: [G; 3], step: &Step| match step {
            Step::Move(by) => [0, 1, 2].map(|axis| point[axis] + G::from_f64(by[axis])),
            Step::Scale(scale) => point.map(|x| x * G::from_f64(*scale)),
        };
        self.steps.iter().fold(point, moved)
    }

    /// The mesh after the steps, computed in a scalar. It keeps the written one's name and digest.
    pub fn mesh(&self, mesh: &Mesh, computed_in: ScalarName) -> Mesh {
        let (wide, narrow) = match computed_in {
            ScalarName::F64 => {
                let wide = mesh.positions_f64.iter().map(|point| self.moved(*point));
                let wide: Vec<[f64; 3]> = wide.collect();
                let narrow = wide.iter().map(|point| point.map(|x| x as f32)).collect();
                (wide, narrow)
            }
            ScalarName::F32 => {
                let narrow = mesh.positions_f32.iter().map(|point| self.moved(*point));
                let narrow: Vec<[f32; 3]> = narrow.collect();
                let wide = narrow.iter().map(|point| point.map(f64::from)).collect();
                (wide, narrow)
            }
        };
        Mesh {
            positions_f64: wide,
            positions_f32: narrow,
            placed: Vec::new(),
            ..mesh.clone()
        }
    }

    /// Rays or points after the steps, computed in `G`. Directions stay as they are, so t is as much longer as the scene.
    pub fn asked<G: Scalar, F: Scalar>(&self, asked: &Asked<G>) -> Asked<F> {
        let rounded = |point: [G; 3]| self.moved(point).map(|x| F::from_f64(x.to_f64()));
        match asked {
            Asked::Rays(rays) => {
                let scale = self.scale();
                let ray = |ray: &Ray<G>| {
                    let direction = ray.direction.map(|x| F::from_f64(x.to_f64()));
                    let on = [ray.t_min, ray.t_max].map(|t| F::from_f64(t.to_f64() * scale));
                    Ray::new(rounded(ray.origin), direction).on(on[0], on[1])
                };
                Asked::Rays(rays.iter().map(ray).collect())
            }
            Asked::Points(points) => {
                Asked::Points(points.iter().map(|point| rounded(*point)).collect())
            }
        }
    }
}

impl Step {
    fn of(word: &str) -> Result<Step, String> {
        let (name, numbers) = word.split_once('=').ok_or(FORM)?;
        let numbers: Result<Vec<f64>, String> = numbers.split(',').map(number::parse).collect();
        let numbers = numbers.map_err(|error| format!("{word}: {error}"))?;
        match (name, &numbers[..]) {
            _ if !numbers.iter().all(|x| x.is_finite()) => {
                Err(format!("{word}: a number is not finite"))
            }
            ("move", &[x, y, z]) => Ok(Step::Move([x, y, z])),
            ("scale", &[scale]) if 0.0 < scale => Ok(Step::Scale(scale)),
            ("scale", &[_]) => Err(format!("{word}: a scale is larger than 0")),
            _ => Err(format!("{word}: {FORM}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_taken_from_left_to_right_in_their_scalar() {
        let steps = GivenSteps::of(" move=-5,0,2  scale=0.5 ").unwrap();
        assert_eq!(steps.text, "move=-5,0,2 scale=0.5");
        assert_eq!(steps.moved([6.0, 1.0, 0.0]), [0.5, 0.5, 1.0]);
        let turned = GivenSteps::of("scale=0.5 move=-5,0,2").unwrap();
        assert_eq!(turned.moved([6.0, 1.0, 0.0]), [-2.0, 0.5, 2.0]);
        // In f32 the sum is rounded before it is scaled.
        let far = GivenSteps::of("move=16777216,0,0 scale=2").unwrap();
        assert_eq!(far.moved([1.0f64, 0.0, 0.0])[0], 33_554_434.0);
        assert_eq!(far.moved([1.0f32, 0.0, 0.0])[0], 33_554_432.0);
    }

    #[test]
    fn the_rays_interval_is_as_much_longer_as_the_scene() {
        let steps = GivenSteps::of("move=0,0,1 scale=4").unwrap();
        let ray = Ray::new([0.0, 0.0, 1.0], [0.0, 0.0, -3.0]).on(0.5, 2.0);
        let Asked::Rays(rays) = steps.asked::<f64, f32>(&Asked::Rays(vec![ray])) else {
            panic!("rays stay rays");
        };
        let expected = Ray::new([0.0f32, 0.0, 8.0], [0.0, 0.0, -3.0]).on(2.0, 8.0);
        assert_eq!(rays, [expected]);
    }

    #[test]
    fn what_is_no_step_is_refused() {
        for (text, message) in [
            ("", "expected steps as"),
            ("scale", "expected steps as"),
            ("move=1,2", "move=1,2: expected steps as"),
            ("turn=1", "turn=1: expected steps as"),
            ("scale=0", "a scale is larger than 0"),
            ("scale=nan", "is not finite"),
            ("scale=x", "scale=x: "),
            ("scale=1e-300 scale=1e-300", "beyond f64"),
        ] {
            let error = GivenSteps::of(text).unwrap_err();
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
