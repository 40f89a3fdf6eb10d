//! Floor 6, beside the command line: an audit from a program's own tests.

#![forbid(unsafe_code)]

#[cfg(feature = "cli")]
mod expectations;
#[cfg(feature = "studies")]
mod explained;
mod outcome;
#[cfg(test)]
mod tests;

#[cfg(feature = "cli")]
pub(crate) use expectations::locked;
pub use outcome::Outcome;

use crate::audit::{self, EpsilonChoice, Plan, Row, Source};
use crate::case::{Parameters, Scene};
use crate::contract::{Across, Contract};
use crate::engine::{self, Unobserved};
use crate::family::{FAMILIES, Family, Stratum, find};
use crate::kernel::{Entry, kept};
use crate::record::{Context, build};
use crate::suggest::did_you_mean;
use hairline_core::{Error, ErrorKind};
use outcome::ALLOWED;
use std::collections::BTreeMap;

/// An audit of a kernel, to be narrowed and run: all families, 2,000 cases of each, seed 1, the
/// kernel's own epsilons and contract, unless said otherwise.
///
/// ```
/// use hairline::{Case, Contract, Entry, FindingKind, Hit, KernelInfo, Vector};
///
/// // The plane's t alone: whatever the triangle, it hits.
/// fn plane(case: &Case<f64>, _: &[f64]) -> Option<Hit<f64>> {
///     let (ray, triangle) = (&case.ray, &case.triangle);
///     let normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
///     let t = normal.dot(triangle.a - ray.origin) / normal.dot(ray.direction);
///     (t >= 0.0).then(|| Hit::at(t))
/// }
///
/// const INFO: KernelInfo = KernelInfo::own("plane", Contract::CLOSED_RAY);
/// let kernel = Entry::new(&INFO).f64(plane);
/// hairline::audit(&kernel).families(["interior"]).count(500).assert_conforms();
/// let outcome = hairline::audit(&kernel).families(["outside"]).count(500).run()?;
/// assert!(outcome.findings().any(|finding| finding.finding == FindingKind::FalseHit));
/// # Ok::<(), hairline::Error>(())
/// ```
pub fn audit(kernel: &Entry) -> Request {
    Request {
        entry: kept(kernel),
        families: None,
        count: 2000,
        seed: 1,
        parameters: Parameters::default(),
        epsilons: EpsilonChoice::Source,
        contract: None,
        promise: None,
        band: None,
        scene: None,
        all_kinds: false,
        attribute: 0,
        allowed: BTreeMap::new(),
        #[cfg(feature = "cli")]
        expectations: None,
    }
}

/// The request for an audit; see [`audit()`].
#[derive(Clone)]
pub struct Request {
    entry: &'static Entry,
    families: Option<Vec<String>>,
    count: u64,
    seed: u64,
    parameters: Parameters,
    epsilons: EpsilonChoice,
    contract: Option<Contract>,
    promise: Option<Across>,
    band: Option<String>,
    scene: Option<String>,
    all_kinds: bool,
    attribute: usize,
    allowed: BTreeMap<String, f64>,
    #[cfg(feature = "cli")]
    expectations: Option<String>,
}

impl Request {
    /// These families only.
    pub fn families<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Request {
        self.families = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// This many indices of each family; 0 counts as 1.
    pub fn count(mut self, count: u64) -> Request {
        self.count = count.max(1);
        self
    }

    /// Another set of random cases.
    pub fn seed(mut self, seed: u64) -> Request {
        self.seed = seed;
        self
    }

    /// How the cases are transformed: a scale, an offset, unit directions.
    pub fn parameters(mut self, parameters: Parameters) -> Request {
        self.parameters = parameters;
        self
    }

    /// Epsilons by the names of their gates; the others as the kernel has them.
    pub fn epsilons(mut self, pairs: &[(&str, &str)]) -> Request {
        let owned = |(gate, value): &(&str, &str)| ((*gate).to_owned(), (*value).to_owned());
        self.epsilons = EpsilonChoice::Given(pairs.iter().map(owned).collect());
        self
    }

    /// Another contract than the kernel's own.
    pub fn contract(mut self, contract: Contract) -> Request {
        self.contract = Some(contract);
        self
    }

    /// Adds the kernel's promise for a ray that crosses a surface, such as [`Across::AtLeastOne`]: no crack.
    pub fn promise(mut self, across: Across) -> Request {
        self.promise = Some(across);
        self
    }

    /// Both answers are right nearer than this to the boundary between hits and misses: `4ulps` of the
    /// triangle's largest coordinate, or `1e-6` of its longest edge.
    pub fn band(mut self, distance: &str) -> Request {
        self.band = Some(distance.to_owned());
        self
    }

    /// Rays in a scene instead of families, as `hairline audit --scene` runs them: `room`, or
    /// `extent=1000,edge=0.01..10,distance=0..2000`. [`Request::families`] may choose its strata.
    pub fn scene(mut self, words: &str) -> Request {
        self.scene = Some(words.to_owned());
        self
    }

    /// All kinds of planes and rays that the scene can have, told apart, as `hairline audit --scene` runs them.
    pub fn all_kinds(mut self) -> Request {
        self.all_kinds = true;
        self
    }

    /// Attributes this many findings of each class of each family to a cause; 0 unless said otherwise.
    pub fn attribute(mut self, count: usize) -> Request {
        self.attribute = count;
        self
    }

    /// Lets a kind of finding, `false-miss`, `false-hit`, `bad-value`, `wrong-value`, `crack`, `double` or
    /// `odd-fold`, occur in
    /// at most this share of the cases of each family and scalar. The cases are the same in every run, so
    /// the answer is too.
    ///
    /// ```
    /// use hairline::{Case, Contract, Entry, Hit, KernelInfo, Vector, audit};
    ///
    /// fn moller_trumbore(case: &Case<f32>, epsilon: f32) -> Option<Hit<f32>> {
    ///     let (ray, [a, b, c]) = (&case.ray, case.triangle.vertices());
    ///     let (ab, ac, from) = (b - a, c - a, ray.origin - a);
    ///     let p = ray.direction.cross(ac);
    ///     let det = ab.dot(p);
    ///     let (u, q) = (from.dot(p) / det, from.cross(ab));
    ///     let (v, t) = (ray.direction.dot(q) / det, ac.dot(q) / det);
    ///     let inside = det.abs() >= epsilon && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    ///     (inside && t >= 0.0).then(|| Hit::at(t))
    /// }
    ///
    /// // In a test of your own:
    /// let room = |epsilon: f32| {
    ///     const MINE: KernelInfo = KernelInfo::own("mine", Contract::CLOSED_RAY);
    ///     let test = move |case: &Case<f32>, _: &[f32]| moller_trumbore(case, epsilon);
    ///     let kernel = Entry::new(&MINE).f32(test);
    ///     audit(&kernel).scene("room").band("4ulps").allow("false-hit", 0.05)
    /// };
    /// room(1e-12).assert_conforms();
    /// // The determinant of a triangle of 1 cm is small from every side.
    /// let outcome = room(1e-3).run()?;
    /// assert!(!outcome.conforms() && outcome.to_string().contains("false-miss"));
    /// # Ok::<(), hairline::Error>(())
    /// ```
    pub fn allow(mut self, finding: &str, share: f64) -> Request {
        self.allowed.insert(finding.to_owned(), share);
        self
    }

    /// Holds it to a reviewed file of what is wrong today, and to the `.lock` file beside it (feature `cli`): a
    /// case more than expected, one less or another one fails the test. The path begins in the package's
    /// folder, where `cargo test` runs; each test has a file of its own.
    ///
    /// `HAIRLINE_BLESS=1 cargo test` writes both files if they are missing or if nothing got worse;
    /// `HAIRLINE_BLESS=worse` writes them in any case. They are as `hairline check` has them (docs/guide/check.md).
    ///
    /// ```
    /// use hairline::{audit, find};
    ///
    /// // In a test of your own, which ends with `.assert_conforms()`.
    /// let kernel = find("moller-trumbore").unwrap();
    /// let mine = audit(kernel).scene("room").expectations("tests/room.toml");
    /// // The file is not there yet, and the error says how to make it.
    /// let error = mine.run().unwrap_err().to_string();
    /// assert!(error.contains("HAIRLINE_BLESS=1 cargo test"), "{error}");
    /// ```
    #[cfg(feature = "cli")]
    pub fn expectations(mut self, path: impl Into<String>) -> Request {
        self.expectations = Some(path.into());
        self
    }

    /// Runs it, in each scalar that the kernel runs in. An error names the family, gate, epsilon, scene,
    /// band or finding that does not exist, or what is wrong with the expectations.
    pub fn run(&self) -> Result<Outcome, Error> {
        for (finding, share) in &self.allowed {
            if !ALLOWED.contains(&finding.as_str()) || !(0.0..=1.0).contains(share) {
                let names = ALLOWED.join(", ");
                let what = format!("allow({finding:?}, {share:?})");
                let line = format!("{what}: expected one of {names}, and a share from 0 to 1");
                return Err(Error::new(ErrorKind::OutOfRange, line));
            }
        }
        #[cfg(feature = "cli")]
        if !self.allowed.is_empty() && self.expectations.is_some() {
            let message = "allow: the file of expectations says what may be wrong; it may have \
                           `rates` by family";
            return Err(Error::new(ErrorKind::Conflict, message));
        }
        let rows = self.rows()?;
        let parameters = Parameters {
            scene: self.parsed_scene()?,
            ..self.parameters.clone()
        };
        let source = |family| Source::of(family, parameters.clone(), self.seed, self.count);
        let mut sources: Vec<Source> = self.chosen_families()?.into_iter().map(source).collect();
        if self.all_kinds {
            let others: Vec<Source> = sources.iter().flat_map(Source::in_other_kinds).collect();
            sources.extend(others);
        }
        let plan = Plan {
            attribute: self.attribute,
            ..Plan::new(rows, sources, self.entry.scalars(), 3)
        };
        let sums = audit::run(&plan, &Unobserved);
        let context = Context {
            seconds: 0.0,
            threads: engine::threads(),
        };
        #[allow(unused_mut)]
        let mut record = build(&plan, &sums, &context);
        #[cfg(feature = "cli")]
        if let Some(file) = &self.expectations {
            expectations::hold(&mut record, file)?;
        }
        Ok(Outcome {
            record,
            allowed: self.allowed.clone(),
        })
    }

    /// Runs it and panics unless the kernel keeps its contract on every case, or as its expectations say. The message has each
    /// kind of finding with its rate and 95 % interval, and the first cases with the command that
    /// shows their truth.
    ///
    /// `HAIRLINE_CASE='behind@2/f32/-/1/7' cargo test NAME` explains one case of it instead (feature `studies`, which `cli`
    /// has).
    #[track_caller]
    pub fn assert_conforms(&self) {
        #[cfg(feature = "studies")]
        if let Some(text) = explained::instead(|| self.rows()) {
            panic!("{text}");
        }
        match self.run() {
            Ok(outcome) => outcome.assert_conforms(),
            Err(error) => panic!("{error}"),
        }
    }

    /// One case of it with the kernel's answer, as `hairline explain` shows it; an error says what is wrong with the id
    /// (feature `studies`).
    #[cfg(feature = "studies")]
    pub fn explain(&self, case: &str) -> Result<String, Error> {
        explained::explained(&self.rows()?, case)
    }

    /// The kernel's verdicts around one case of it as an SVG, as `hairline map` draws them: one pixel a float of the ray's
    /// origin (feature `studies`).
    #[cfg(feature = "studies")]
    pub fn map(&self, case: &str) -> Result<String, Error> {
        let rows = self.rows()?;
        let first = rows
            .first()
            .ok_or_else(|| Error::new(ErrorKind::Unsupported, "the kernel has no epsilons"))?;
        explained::mapped(first, case)
    }

    fn rows(&self) -> Result<Vec<Row>, Error> {
        let band = self.band.as_deref().map(str::parse).transpose();
        let band = band.map_err(|error: Error| error.about("band"))?;
        let mut rows = self.epsilons.rows(&[self.entry], None)?;
        for row in &mut rows {
            row.contract = self.contract.unwrap_or(row.contract);
            row.contract.across = self.promise.unwrap_or(row.contract.across);
            row.contract.band = band.or(row.contract.band);
        }
        rows.iter().try_for_each(|row| row.check_in([true; 2]))?;
        Ok(rows)
    }

    fn chosen_families(&self) -> Result<Vec<&'static Family>, Error> {
        let all: Vec<&'static Family> = match self.scene {
            Some(_) => Stratum::ALL.map(Stratum::family).into(),
            None => FAMILIES.iter().collect(),
        };
        let Some(names) = &self.families else {
            return Ok(all);
        };
        let known = |name: &String| {
            let family =
                find(name).filter(|family| all.iter().any(|other| other.name == family.name));
            family.ok_or_else(|| {
                let names = all.iter().map(|family| family.name);
                let advice = did_you_mean(name, names, "hairline list families");
                let line = format!("unknown family '{name}'{advice}");
                Error::new(ErrorKind::UnknownName, line)
            })
        };
        names.iter().map(known).collect()
    }

    /// The scene, which the scalars of the kernel can hold.
    fn parsed_scene(&self) -> Result<Option<Scene>, Error> {
        let Some(words) = &self.scene else {
            return Ok(self.parameters.scene.clone());
        };
        let about = |error: String| Error::syntax(error).about("scene");
        let (scene, _) = Scene::parse(words).map_err(about)?;
        let (_, why) = scene.held_in(self.entry.scalars()).map_err(about)?;
        why.map_or(Ok(Some(scene.to_try_kernels(words))), |why| Err(about(why)))
    }
}
