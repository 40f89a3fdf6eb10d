//! How the numbers of a scene are read and written.

use super::{PlaneKind, RayKind, Scene, SceneInterval, Toward};
use std::fmt;

/// The extent that words give; 1 if they give none that is a length.
pub(super) fn extent_in<'a>(mut words: impl Iterator<Item = &'a str>) -> f64 {
    let given = |word: &str| {
        let (_, value) = word
            .split_once('=')
            .filter(|(key, _)| key.trim() == "extent")?;
        value
            .trim()
            .parse()
            .ok()
            .filter(|extent: &f64| extent.is_finite() && 0.0 < *extent)
    };
    words.find_map(given).unwrap_or(1.0)
}

/// A finite number.
pub(super) fn number(key: &str, text: &str) -> Result<f64, String> {
    let number = text
        .trim()
        .parse()
        .ok()
        .filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| {
        let (whole, text) = (text, text.trim());
        let starts_with_digit = text.starts_with(|c: char| c.is_ascii_digit());
        let has_unit = starts_with_digit && text.ends_with(|c: char| c.is_ascii_alphabetic());
        let is_number = |end: &str| end.trim().parse::<f64>().is_ok();
        let takes_two = ["edge", "distance", "sine"].contains(&key);
        let mut places = text.match_indices('-').map(|(place, _)| place);
        let is_range =
            takes_two && places.any(|at| is_number(&text[..at]) && is_number(&text[at + 1..]));
        let unit = if text.contains('=') {
            ": a comma stands between the words, as extent=5,edge=0.1..2"
        } else if has_unit {
            ": write all lengths in one unit, without its name"
        } else if is_range {
            ": a range is written LOW..HIGH"
        } else {
            ""
        };
        format!("{key}={whole}: '{text}' is not a finite number{unit}")
    })
}

/// Two finite numbers in order; one stands for both.
pub(super) fn range(key: &str, text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once("..").unwrap_or((text, text));
    if high.starts_with('.') {
        return Err(format!(
            "{key}={text}: write a range with two dots, as 0.5..2"
        ));
    }
    if low.trim().is_empty() || high.trim().is_empty() {
        return Err(format!(
            "{key}={text}: write both ends, as 0.5..2, or one number"
        ));
    }
    let [low, high] = [number(key, low)?, number(key, high)?];
    if high < low {
        return Err(format!(
            "{key}={text}: the range is empty; write the smaller number first"
        ));
    }
    Ok([low, high])
}

/// Sizes: a range, perhaps with the number in its middle that half of them are below.
pub(super) fn sizes(key: &str, text: &str) -> Result<([f64; 2], Option<f64>), String> {
    let Some((low, rest)) = text.split_once("..") else {
        return Ok((range(key, text)?, None));
    };
    let Some((middle, high)) = rest.split_once("..") else {
        return Ok((range(key, text)?, None));
    };
    if [low, middle, high]
        .iter()
        .any(|part| part.trim().is_empty() || part.contains(".."))
    {
        return Err(format!(
            "{key}={text}: write two numbers or three, as 0.05..20 or 0.05..0.1..20"
        ));
    }
    let [low, middle, high] = [number(key, low)?, number(key, middle)?, number(key, high)?];
    if middle < low || high < middle {
        return Err(format!(
            "{key}={text}: write the smallest, then the one that half are below, then the largest"
        ));
    }
    Ok(([low, high], Some(middle)))
}

/// A number in as few digits as bring it back.
pub struct ShortNumber(pub f64);

impl fmt::Display for ShortNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            0.0 => f.write_str("0"),
            size if (1e-4..1e7).contains(&size) => write!(f, "{}", self.0),
            _ => write!(f, "{:e}", self.0),
        }
    }
}

/// A range, or the one number that it holds; with the number that half of the sizes in it are below, if there is one.
pub(super) struct Sizes(pub [f64; 2], pub Option<f64>);

impl fmt::Display for Sizes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Sizes([low, high], middle) = *self;
        write!(f, "{}", ShortNumber(low))?;
        if let Some(middle) = middle {
            write!(f, "..{}", ShortNumber(middle))?;
        }
        if middle.is_some() || low != high {
            write!(f, "..{}", ShortNumber(high))?;
        }
        Ok(())
    }
}

impl fmt::Display for Scene {
    /// The words that make it again, as they stand in case ids.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (edge, distance) = (
            Sizes(self.edge, self.median_edge),
            Sizes(self.distance, None),
        );
        let (extent, direction) = (ShortNumber(self.extent), self.direction);
        write!(f, "extent={extent},")?;
        if self.center != 0.0 {
            write!(f, "center={},", ShortNumber(self.center))?;
        }
        write!(f, "edge={edge},distance={distance},direction={direction}")?;
        self.sine
            .map_or(Ok(()), |sine| write!(f, ",sine={}", Sizes(sine, None)))?;
        if self.aims_inside {
            f.write_str(",aim=inside")?;
        }
        if self.ray != RayKind::Stored {
            write!(f, ",ray={}", self.ray.name())?;
        }
        if self.plane != PlaneKind::Generic {
            write!(f, ",plane={}", self.plane.name())?;
        }
        if self.toward != Toward::Any {
            write!(f, ",toward={}", self.toward.name())?;
        }
        match self.interval {
            SceneInterval::Whole => Ok(()),
            interval => write!(f, ",interval={interval}"),
        }
    }
}
