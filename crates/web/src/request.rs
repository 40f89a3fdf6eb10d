//! The requests. An answer is a JSON object; one with the field `error` says in a line what is wrong.

use crate::answers;
use crate::kernel::Chosen;
use hairline::internals::audit::shell_word;
use serde::{Deserialize, Serialize};

#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
enum Request {
    /// The choices.
    About,
    Audit(Audit),
    Curve(Curve),
    Explain(Explain),
    Map(Map),
    Mesh(Mesh),
    /// The exact truth of an id, or of a case as JSON.
    Truth {
        case: String,
    },
}

/// A kernel on families of cases, or on the rays of a scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Audit {
    pub kernel: Chosen,
    pub cases: Cases,
}

/// Which cases, in one scalar.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cases {
    /// `f32` or `f64`.
    pub scalar: String,
    /// As `--scene` takes it; families if it is not given.
    pub scene: Option<String>,
    /// By name; all if there are none.
    #[serde(default)]
    pub families: Vec<String>,
    /// In each family.
    pub count: u64,
    #[serde(default = "first")]
    pub seed: u64,
}

impl Cases {
    /// The flags that choose them on a command line.
    pub fn flags(&self) -> String {
        self.flags_of(&self.families)
    }

    /// Those with which `hairline epsilon` studies such cases: it takes a scene whole.
    pub fn epsilon_flags(&self) -> String {
        match self.scene {
            Some(_) => self.flags_of(&[]),
            None => self.flags(),
        }
    }

    fn flags_of(&self, families: &[String]) -> String {
        let Cases {
            scalar,
            scene,
            count,
            seed,
            ..
        } = self;
        let scene = scene
            .as_ref()
            .map(|words| format!(" --scene {}", shell_word(words)));
        let chosen = (!families.is_empty()).then(|| format!(" --family {}", families.join(",")));
        let seed = (*seed != first()).then(|| format!(" --seed {seed}"));
        let [scene, chosen, seed] = [scene, chosen, seed].map(Option::unwrap_or_default);
        format!("--scalar {scalar}{scene}{chosen} -n {count}{seed}")
    }
}

fn first() -> u64 {
    1
}

/// The shares of false hits and false misses as one epsilon grows.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    pub kernel: Chosen,
    pub cases: Cases,
    /// `--epsilon` arguments, one for each point.
    pub epsilons: Vec<String>,
}

/// One case and all that is known of it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explain {
    pub kernel: Chosen,
    /// An id, or a case as JSON.
    pub case: String,
}

/// The verdicts around a case, one pixel a float.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Map {
    pub kernel: Chosen,
    /// An id, or a case as JSON.
    pub case: String,
    /// `origin`, `direction`, `a`, `b` or `c`.
    pub vary: String,
    /// Steps from the case to the middle: to the right, and upwards.
    pub shift: [i32; 2],
    /// How many times as far as by default the pixels are apart: a power of two.
    pub zoom: u32,
    /// Pixels to the right, and upwards.
    pub size: [usize; 2],
    /// The pixel whose case is asked for, from the left and from the bottom; no map is made then.
    pub pixel: Option<[usize; 2]>,
}

/// The cracks of the mesh that is the file kept.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    pub kernel: Chosen,
    /// The file's name, whose ending says its format.
    pub file: String,
    /// `f32` or `f64`.
    pub scalar: String,
    /// Rays at each edge and vertex.
    pub directions: u64,
}

/// The answer to a request.
pub fn answer(text: &[u8], file: &[u8]) -> String {
    let written = |answer: &dyn Written| answer.json();
    let answered = || -> Result<String, String> {
        let request = serde_json::from_slice(text).map_err(|error| format!("request: {error}"))?;
        match request {
            Request::About => written(&answers::about()),
            Request::Audit(asked) => written(&answers::audit(&asked)?),
            Request::Curve(asked) => written(&answers::curve(&asked)?),
            Request::Explain(asked) => written(&answers::explain(&asked)?),
            Request::Map(asked) => written(&answers::map(&asked)?),
            Request::Mesh(asked) => written(&answers::mesh(&asked, file)?),
            Request::Truth { case } => written(&answers::truth(&case)?),
        }
    };
    answered().unwrap_or_else(|error| serde_json::json!({ "error": error }).to_string())
}

trait Written {
    fn json(&self) -> Result<String, String>;
}

impl<T: Serialize> Written for T {
    fn json(&self) -> Result<String, String> {
        serde_json::to_string(self).map_err(|error| error.to_string())
    }
}
