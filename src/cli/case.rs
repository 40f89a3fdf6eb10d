//! The case that a command line names: an id, the name of a stored case, or JSON.

use super::exit::Failure;
use super::flags::{find_family, find_kernel, placed, unknown};
use super::input::{corpus_files, name_of, read_corpus, read_mesh};
use super::vectors::core_set;
use crate::arith::ScalarName;
use crate::case::{AnyScalar, Case, CaseId, Instance};
use crate::corpus::lines::{self, AnyCase, StoredCase};
use crate::family::{self, Family, Grouping, MeshFamily, Stratum};
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use crate::mesh::{AimedPart, SceneMesh, Surface, Targets, Topology};
use crate::vectors::{DIGITS, VectorTest, in_scalar};
use clap::Args;
use std::sync::Arc;

/// Which case.
#[derive(Args)]
pub struct CaseArguments {
    /// A case id, the id of a test vector, the name of a stored case, or a case as JSON
    #[arg(value_name = "CASE")]
    pub case: String,

    /// The mesh that the case's id names
    #[arg(long, value_name = "FILE")]
    pub(super) mesh: Option<String>,

    /// Where the stored case is: a JSON lines file, or a folder of them
    #[arg(long, value_name = "FILE|DIR")]
    pub(super) corpus: Option<String>,
}

/// Cases in one of the scalars.
pub type Cases = AnyScalar<Group<f32>, Group<f64>>;

/// One case, or the triangles of a group.
pub struct Group<F: Scalar> {
    /// A ray and each triangle.
    pub cases: Vec<Case<F>>,
    /// How they belong together.
    pub grouping: Grouping,
    /// The triangles around those of the group; `None` if they are too many to be asked, or cannot be made.
    pub neighbours: Option<Vec<Case<F>>>,
    /// Where the triangles are put, if an id says so; then the rays are of the world.
    pub instance: Option<Instance<F>>,
}

impl<F: Scalar> Group<F> {
    fn alone(cases: Vec<Case<F>>, grouping: Grouping) -> Group<F> {
        Group {
            cases,
            grouping,
            neighbours: Some(Vec::new()),
            instance: None,
        }
    }
}

impl CaseArguments {
    /// The cases, or why there are none; an instance is one of the reasons.
    pub fn cases(&self) -> Result<Cases, Failure> {
        let cases = self.cases_and_instances()?;
        if either_scalar!(&cases, group => group.instance.is_some()) {
            let message = format!(
                "'{}' is a case of an instance: only `explain` takes it",
                self.case
            );
            return Err(Failure::usage(message));
        }
        Ok(cases)
    }

    /// The one triangle among the cases.
    pub(super) fn one<'a, F: Scalar>(&self, group: &'a Group<F>) -> Result<&'a Case<F>, Failure> {
        let [case] = &group.cases[..] else {
            let (name, count) = (&self.case, group.cases.len());
            return Err(Failure::usage(format!(
                "'{name}' has {count} triangles: say which, as {name}.0 to {name}.{}",
                count - 1
            )));
        };
        Ok(case)
    }

    /// The cases, whose rays are of the world if there is an instance, or why there are none.
    pub fn cases_and_instances(&self) -> Result<Cases, Failure> {
        if let Some(path) = &self.corpus {
            return self.stored(path);
        }
        if self
            .case
            .trim_start_matches('\u{feff}')
            .trim_start()
            .starts_with(['{', '['])
        {
            let stored: Vec<_> = lines::read(self.case.as_bytes(), "argument")
                .take(2)
                .collect::<Result<_, _>>()?;
            let [stored] = &stored[..] else {
                let found = if stored.is_empty() { "none" } else { "more" };
                return Err(Failure::usage(format!(
                    "the argument should hold one case, found {found}"
                )));
            };
            return Ok(stored_cases(stored));
        }
        if let Some(test) = self.test_vector() {
            return test;
        }
        let id: CaseId = self.case.parse().map_err(|error| {
            Failure::usage(format!(
                "{error}; for the name of a stored case add --corpus FILE"
            ))
        })?;
        match id.scalar {
            ScalarName::F32 => in_world(&id, self.mesh.as_deref()).map(Cases::F32),
            ScalarName::F64 => in_world(&id, self.mesh.as_deref()).map(Cases::F64),
        }
    }

    /// The cases of a test of the core set of vectors; none if the word is not like its ids.
    fn test_vector(&self) -> Option<Result<Cases, Failure>> {
        let (_, digest) = self.case.rsplit_once('-')?;
        let is_digest = digest.len() == DIGITS && digest.bytes().all(|b| b.is_ascii_hexdigit());
        if !is_digest || self.case.contains('/') {
            return None;
        }
        let mut tests = core_set().into_iter().flat_map(|(_, tests)| tests);
        let Some(VectorTest {
            cases, grouping, ..
        }) = tests.find(|test| test.id == self.case)
        else {
            let message = format!(
                "no test of the core set of vectors has the id '{}'",
                self.case
            );
            return Some(Err(Failure::usage(message)));
        };
        Some(Ok(alone(&cases, grouping)))
    }

    fn stored(&self, path: &str) -> Result<Cases, Failure> {
        let (mut names, mut found) = (Vec::new(), Vec::new());
        for file in corpus_files(path)? {
            for stored in read_corpus(&file)? {
                names.push(name_of(&stored));
                if names.last() == Some(&self.case) {
                    found.push((format!("{file}:{}", stored.line), stored));
                }
            }
        }
        if let [(_, stored)] = &found[..] {
            return Ok(stored_cases(stored));
        }
        if found.is_empty() {
            let names = names.iter().map(String::as_str);
            return Err(unknown(
                "case",
                &self.case,
                names,
                &format!("hairline truth {path}"),
            ));
        }
        let places: Vec<&str> = found.iter().map(|(place, _)| place.as_str()).collect();
        Err(Failure::usage(format!(
            "{} cases are called '{}': {}; name the file with --corpus",
            found.len(),
            self.case,
            places.join(", ")
        )))
    }
}

/// Cases without a mesh around them, which are all in one scalar.
fn alone(cases: &[AnyCase], grouping: Grouping) -> Cases {
    match cases[0] {
        AnyCase::F32(_) => Cases::F32(Group::alone(in_scalar(cases), grouping)),
        AnyCase::F64(_) => Cases::F64(Group::alone(in_scalar(cases), grouping)),
    }
}

fn stored_cases(stored: &StoredCase) -> Cases {
    let grouping = if stored.is_secondary {
        Grouping::SecondaryRay
    } else {
        Grouping::Single
    };
    alone(&[stored.case], grouping)
}

/// The cases of an id, whose rays are brought to the world if it has an instance.
fn in_world<F: Scalar>(id: &CaseId, mesh: Option<&str>) -> Result<Group<F>, Failure> {
    let group = from_id(id, mesh)?;
    let Some(matrix) = id.parameters.instance else {
        return Ok(group);
    };
    let instance = placed(matrix.map(|row| row.map(F::from_f64)))?;
    let moved = |cases: Vec<Case<F>>| cases.iter().map(|case| instance.in_world(case)).collect();
    let Group {
        cases,
        grouping,
        neighbours,
        ..
    } = group;
    let neighbours = neighbours.map(moved);
    Ok(Group {
        cases: moved(cases),
        grouping,
        neighbours,
        instance: Some(instance),
    })
}

/// The cases of an id as they are made, and how they belong together.
fn from_id<F: Scalar>(id: &CaseId, mesh: Option<&str>) -> Result<Group<F>, Failure> {
    if let Some(name) = &id.parameters.kernel {
        find_kernel(name)?;
    }
    if let Some(digest) = &id.parameters.mesh {
        let path = mesh.ok_or_else(|| {
            Failure::usage(format!("'{id}' is a case of a mesh: add --mesh FILE"))
        })?;
        let mesh = read_mesh(path, true)?;
        if mesh.digest != *digest {
            let message = format!(
                "{path}: its digest is {}, the case's mesh has {digest}",
                mesh.digest
            );
            return Err(Failure::bad_input(message));
        }
        if let Some(part) = AimedPart::named(&id.family) {
            return around_target(id, &mesh, part);
        }
        let family = MeshFamily::new(mesh, path);
        if let Some(stratum) = Stratum::named(&id.family) {
            return of_scene_mesh(id, family, stratum);
        }
        let case = family.make(&id.parameters, id.seed, id.index);
        return Ok(Group::alone(vec![case], Grouping::Single));
    }
    family_of(id, id.family.strip_suffix("-all").unwrap_or(&id.family))?;
    let (cases, grouping) = family::cases_of(id).map_err(Failure::usage)?;
    let neighbours = family::around(&cases, grouping);
    Ok(Group {
        neighbours,
        ..Group::alone(cases, grouping)
    })
}

/// The triangle of a group that an id names, or all.
fn chosen_triangle<F: Scalar>(id: &CaseId, cases: Vec<Case<F>>) -> Result<Vec<Case<F>>, Failure> {
    let Some(triangle) = id.triangle else {
        return Ok(cases);
    };
    Ok(vec![
        family::chosen_triangle(id, triangle, &cases).map_err(Failure::usage)?,
    ])
}

/// The cases of a ray at an edge or vertex of a mesh.
fn around_target<F: Scalar>(
    id: &CaseId,
    mesh: &Mesh,
    part: AimedPart,
) -> Result<Group<F>, Failure> {
    if !Targets::makes(id) {
        let message = format!("'{id}': this program makes another version of its family");
        return Err(Failure::bad_input(message));
    }
    let topology = Topology::of::<F>(mesh);
    let targets = Targets::new(mesh, &topology, &id.parameters, id.seed);
    if targets.count(part) == 0 {
        let message = format!("'{id}': the mesh has no edge or vertex that is asked about");
        return Err(Failure::bad_input(message));
    }
    let mut cases = Vec::new();
    targets.make(part, id.index, &mut cases);
    let mut around = Vec::new();
    let few = targets.add_neighbours((part, id.index), &cases[0].ray, &mut around);
    let neighbours = few.then_some(around);
    Ok(Group {
        neighbours,
        ..Group::alone(chosen_triangle(id, cases)?, part.grouping())
    })
}

/// The cases of a stratum of the scene that a mesh is.
fn of_scene_mesh<F: Scalar>(
    id: &CaseId,
    family: MeshFamily,
    stratum: Stratum,
) -> Result<Group<F>, Failure> {
    let grouping = family_of(id, &id.family)?.grouping;
    let scalars = F::NAME.alone();
    let mesh = SceneMesh::new(Surface::new(Arc::new(family), scalars));
    if mesh.count::<F>(stratum, 1) == 0 {
        let message = format!("'{id}': the mesh has nothing that such rays are aimed at");
        return Err(Failure::bad_input(message));
    }
    let made = mesh.make::<F>(stratum, &id.parameters, id.seed, id.index);
    let (mut around, ray) = (Vec::new(), &made.cases()[0].ray);
    let draw = &mut stratum.draw(id.seed, id.index);
    let is_asked = mesh.add_neighbours(stratum, draw, ray, &mut around);
    let neighbours = is_asked.then_some(around);
    let cases = chosen_triangle(id, made.cases().to_vec())?;
    Ok(Group {
        neighbours,
        ..Group::alone(cases, grouping)
    })
}

/// The family of an id, which must be of the version that this program makes.
fn family_of(id: &CaseId, name: &str) -> Result<&'static Family, Failure> {
    let family = find_family(name)?;
    if family.version != id.version {
        let message = format!(
            "'{id}' is of version {} of family '{name}', this program makes version {}",
            id.version, family.version
        );
        return Err(Failure::bad_input(message));
    }
    Ok(family)
}
