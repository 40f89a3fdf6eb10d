//! Offset schemes: the published ones by name, and a program's own.

use super::hit::{HitPoint, Offset};
use super::published::{PUBLISHED, PublishedScheme};
use crate::arith::Float;
use crate::suggest::did_you_mean;
use std::any::Any;
use std::sync::{Arc, PoisonError, RwLock};

/// An offset scheme with its parameter, in one or both scalars.
#[derive(Clone)]
pub struct Scheme {
    /// As `--scheme` takes it: `normal=1e-3`, `pbrt-v4`.
    pub name: String,
    /// Author, title, year and address.
    pub source: String,
    /// The flags that choose it.
    pub flags: String,
    f32: Option<Arc<dyn Offset<f32>>>,
    f64: Option<Arc<dyn Offset<f64>>>,
}

impl Scheme {
    /// A scheme of your own; [`Scheme::f32`] and [`Scheme::f64`] give it its formulas.
    ///
    /// ```
    /// # extern crate hairline_advice as hairline;
    /// use hairline::{HitPoint, Scheme, Start};
    ///
    /// let up = |hit: &HitPoint<f32>| {
    ///     Start::at([0, 1, 2].map(|i| hit.point[i] + hit.normal[i] * 0.01))
    /// };
    /// hairline::register_scheme(Scheme::own("a-centimetre").f32(up)).unwrap();
    /// ```
    pub fn own(name: &str) -> Scheme {
        let (name, source) = (name.to_owned(), "your own".to_owned());
        Scheme {
            flags: format!("--scheme {name}"),
            name,
            source,
            f32: None,
            f64: None,
        }
    }

    /// The same, chosen by other flags.
    pub fn chosen_by(self, flags: String) -> Scheme {
        Scheme { flags, ..self }
    }

    /// The same with a formula in `f32`.
    pub fn f32(self, offset: impl Offset<f32> + 'static) -> Scheme {
        Scheme {
            f32: Some(Arc::new(offset)),
            ..self
        }
    }

    /// The same with a formula in `f64`.
    pub fn f64(self, offset: impl Offset<f64> + 'static) -> Scheme {
        Scheme {
            f64: Some(Arc::new(offset)),
            ..self
        }
    }

    /// Its formula in a scalar, if it has one.
    pub fn offset<F: Float>(&self) -> Option<&dyn Offset<F>> {
        let both: [&dyn Any; 2] = [&self.f32, &self.f64];
        let found = both
            .into_iter()
            .find_map(|f| f.downcast_ref::<Option<Arc<dyn Offset<F>>>>());
        found?.as_deref()
    }

    /// A published scheme with a parameter, which both scalars take if the scheme runs in them.
    pub(super) fn published(
        published: &'static PublishedScheme,
        parameter: Option<&str>,
    ) -> Scheme {
        let formula = published.formula;
        let name = match parameter {
            Some(value) => format!("{}={value}", published.name),
            None => published.name.to_owned(),
        };
        let text = parameter
            .or(published.parameter.map(|p| p.default))
            .unwrap_or("0");
        let (narrow, wide) = (f32::parse(text), f64::parse(text));
        let scheme = Scheme {
            source: published.source.to_owned(),
            ..Scheme::own(&name)
        };
        let narrow = narrow.unwrap_or(f32::NAN);
        let scheme = scheme.f32(move |hit: &HitPoint<f32>| formula.start(narrow, hit));
        if published.only_f32 {
            return scheme;
        }
        let wide = wide.unwrap_or(f64::NAN);
        scheme.f64(move |hit: &HitPoint<f64>| formula.start(wide, hit))
    }
}

/// The schemes that a program added.
static ADDED: RwLock<Vec<Scheme>> = RwLock::new(Vec::new());

/// Adds a scheme for the rest of the process; `hairline offset` then knows its name. An error if the name
/// is taken or no word.
pub fn register(scheme: Scheme) -> Result<(), String> {
    let name = scheme.name.clone();
    let is_word = |c: char| c.is_ascii_alphanumeric() || "-_.+@".contains(c);
    if name.is_empty() || !name.chars().all(is_word) {
        return Err(format!(
            "'{}' is no name for a scheme: use letters, digits and -_.+@",
            name.escape_default()
        ));
    }
    let mut added = ADDED.write().unwrap_or_else(PoisonError::into_inner);
    let is_taken = PUBLISHED.iter().any(|published| published.name == name)
        || added.iter().any(|other| other.name == name);
    if is_taken {
        return Err(format!("there are two schemes of the name '{name}'"));
    }
    added.push(scheme);
    Ok(())
}

fn added() -> Vec<Scheme> {
    ADDED.read().unwrap_or_else(PoisonError::into_inner).clone()
}

/// Every scheme, each published one with its default parameter.
pub fn all() -> Vec<Scheme> {
    let published = PUBLISHED
        .iter()
        .map(|published| Scheme::published(published, None));
    published.chain(added()).collect()
}

/// The schemes that run if nobody names one: the published ones, some with two values, and a program's own.
pub fn default_schemes() -> Vec<Scheme> {
    let of = |published: &'static PublishedScheme| {
        let values = published
            .usual
            .iter()
            .map(|value| Scheme::published(published, *value));
        values.collect::<Vec<_>>()
    };
    PUBLISHED.iter().flat_map(of).chain(added()).collect()
}

/// True if a scheme of this name needs the hit's t.
pub fn needs_t(name: &str) -> bool {
    name.split('=').next() == Some("t-relative")
}

/// `: p + n * 0.01`, how a scheme of this name starts a ray; empty of a program's own.
pub fn describe(name: &str) -> String {
    let (word, value) = name.split_once('=').unwrap_or((name, ""));
    let published = PUBLISHED.iter().find(|published| published.name == word);
    published.map_or(String::new(), |published| {
        let default = published
            .parameter
            .map_or("", |parameter| parameter.default);
        format!(
            ": {}",
            published
                .start
                .replace('#', if value.is_empty() { default } else { value })
        )
    })
}

/// The scheme of a word such as `waechter-binder` or `normal=1e-3`.
pub fn parse(text: &str) -> Result<Scheme, String> {
    let (name, value) = match text.split_once('=') {
        Some((name, value)) => (name.trim(), Some(value.trim())),
        None => (text.trim(), None),
    };
    let Some(published) = PUBLISHED.iter().find(|published| published.name == name) else {
        let own = added();
        if let Some(scheme) = own.iter().find(|scheme| scheme.name == name) {
            return match value {
                Some(_) => Err(format!("'{name}' takes no value")),
                None => Ok(scheme.clone()),
            };
        }
        let names = PUBLISHED.iter().map(|published| published.name);
        let names = names.chain(own.iter().map(|scheme| scheme.name.as_str()));
        let advice = did_you_mean(name, names, "hairline list schemes");
        return Err(format!("unknown scheme '{name}'{advice}"));
    };
    let Some(value) = value else {
        return Ok(Scheme::published(published, None));
    };
    let Some(parameter) = published.parameter else {
        return Err(format!("'{name}' takes no value"));
    };
    let number = f64::parse(value).filter(|x| x.is_finite() && 0.0 <= *x);
    let fits = number.is_some_and(|x| (x as f32).is_finite() && (x == 0.0 || x as f32 != 0.0));
    if !fits {
        let what = parameter.what;
        return Err(format!(
            "{name}={value}: write {what} as a number from 0 up, such as {}",
            parameter.default
        ));
    }
    Ok(Scheme::published(published, Some(value)))
}
