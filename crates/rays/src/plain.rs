//! A plain program over a mesh, as most renderers are: a tree of boxes, a slab test for them, and a triangle test. It has no
//! guards but those of the two tests, so that its answers show what these lose.

use crate::asked::Answers;
use crate::audit::Row as KernelRow;
use crate::case::{Case, Triangles};
use crate::files::mesh::Mesh;
use crate::kernel::{KernelIn, Scalar, Verdict, verdicts_of};
use crate::single::{around, case_of};
use hairline_boxes::{BoxCase, Boxes, Setup};
use hairline_scene::{Answer, Ray};
use rayon::prelude::*;

/// Which tests it has.
pub struct PlainProgram {
    /// The triangle test.
    pub kernel: KernelRow,
    /// The box test; without one it asks about every face.
    pub box_test: Option<Setup>,
}

/// The most faces of a leaf.
const LEAF: usize = 4;

/// A node over some faces.
struct Node<F> {
    /// The box around them, exactly.
    corners: [[F; 3]; 2],
    below: Below<F>,
}

enum Below<F> {
    Faces(Vec<u32>),
    Nodes(Box<[Node<F>; 2]>),
}

/// The nearest hits of rays. An error if a test does not run in this scalar.
pub fn answered<F: Scalar>(
    program: &PlainProgram,
    mesh: &Mesh,
    rays: &[Ray<F>],
) -> Result<Answers, String> {
    let entry = program.kernel.entry;
    let kernel = F::subject(entry).ok_or_else(|| {
        let name = entry.info.name;
        format!("{name} does not run in {}", F::NAME)
    })?;
    let boxes = match &program.box_test {
        None => None,
        Some(setup) => Some(BoxTest::new(setup)?),
    };
    let mut faces: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    let running = Running {
        mesh,
        kernel,
        epsilons: program.kernel.epsilons(),
        root: (boxes.is_some() && !faces.is_empty()).then(|| Node::over(mesh, &mut faces)),
        boxes,
    };
    let answers = rays.par_iter().map(|ray| running.nearest(ray));
    Ok(Answers::Nearest(answers.collect()))
}

impl PlainProgram {
    /// The tests by name.
    pub fn label(&self) -> String {
        let kernel = self.kernel.label();
        match &self.box_test {
            None => format!("{kernel}, every face asked"),
            Some(setup) => format!("{kernel}, boxes by {}", setup.entry.info.name),
        }
    }
}

/// A slab test with its epsilons.
struct BoxTest<F: Scalar> {
    test: &'static dyn KernelIn<F, Boxes>,
    epsilons: Vec<F>,
}

impl<F: Scalar> BoxTest<F> {
    fn new(setup: &Setup) -> Result<BoxTest<F>, String> {
        let epsilons = setup.epsilons().ok_or_else(|| {
            let name = setup.entry.info.name;
            format!("an epsilon of {name} is no finite number of {}", F::NAME)
        })?;
        Ok(BoxTest {
            test: setup.subject()?,
            epsilons,
        })
    }
}

impl<F: Scalar> Node<F> {
    /// Over some faces, one at least: cut at the median of their middles, along the longest side of the box.
    fn over(mesh: &Mesh, faces: &mut [u32]) -> Node<F> {
        let corners_of = |face: &u32| mesh.vertices::<F>(*face as usize);
        let points: Vec<[F; 3]> = faces.iter().flat_map(corners_of).collect();
        let corners = around(&points);
        if faces.len() <= LEAF {
            return Node {
                corners,
                below: Below::Faces(faces.to_vec()),
            };
        }
        let side = |axis: usize| corners[1][axis].to_f64() - corners[0][axis].to_f64();
        let axis = (0..3)
            .max_by(|a, b| side(*a).total_cmp(&side(*b)))
            .unwrap_or(0);
        let middle = |face: &u32| {
            let corners = corners_of(face).map(|corner| corner[axis].to_f64());
            corners.iter().sum::<f64>()
        };
        let half = faces.len() / 2;
        faces.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
        let (low, high) = faces.split_at_mut(half);
        Node {
            corners,
            below: Below::Nodes(Box::new([Node::over(mesh, low), Node::over(mesh, high)])),
        }
    }
}

/// The program over one mesh.
struct Running<'a, F: Scalar> {
    mesh: &'a Mesh,
    kernel: &'static dyn KernelIn<F, Triangles>,
    epsilons: Vec<F>,
    boxes: Option<BoxTest<F>>,
    /// The tree; none if every face is asked about.
    root: Option<Node<F>>,
}

impl<F: Scalar> Running<'_, F> {
    fn nearest(&self, ray: &Ray<F>) -> Answer {
        let mut ray = *ray;
        let mut nearest = Answer {
            face: None,
            t: None,
        };
        match (&self.root, &self.boxes) {
            (Some(root), Some(boxes)) => self.visit(root, boxes, &mut ray, &mut nearest),
            _ => {
                let all: Vec<u32> = (0..self.mesh.triangles.len() as u32).collect();
                self.ask(&all, &mut ray, &mut nearest);
            }
        }
        nearest
    }

    fn visit(&self, node: &Node<F>, boxes: &BoxTest<F>, ray: &mut Ray<F>, nearest: &mut Answer) {
        let case = BoxCase::new(ray.origin, ray.direction, node.corners).on(ray.t_min, ray.t_max);
        let mut verdict = [Verdict::miss(None)];
        verdicts_of(boxes.test, &[case], &boxes.epsilons, &mut verdict);
        if !verdict[0].hit {
            return;
        }
        match &node.below {
            Below::Faces(faces) => self.ask(faces, ray, nearest),
            Below::Nodes(nodes) => {
                for node in nodes.iter() {
                    self.visit(node, boxes, ray, nearest);
                }
            }
        }
    }

    /// Asks the triangle test about some faces; a hit on the interval ends that at its t.
    fn ask(&self, faces: &[u32], ray: &mut Ray<F>, nearest: &mut Answer) {
        let cases: Vec<Case<F>> = faces
            .iter()
            .map(|face| case_of(self.mesh, ray, *face))
            .collect();
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        verdicts_of(self.kernel, &cases, &self.epsilons, &mut verdicts);
        for (face, verdict) in faces.iter().zip(verdicts) {
            let is_on_interval = ray.t_min <= verdict.t && verdict.t <= ray.t_max;
            if verdict.hit && is_on_interval {
                ray.t_max = verdict.t;
                *nearest = Answer {
                    face: Some(*face),
                    t: Some(verdict.t.to_f64()),
                };
            }
        }
    }
}
