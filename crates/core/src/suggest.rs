//! Floor 1: what to say about a mistyped name.

#![forbid(unsafe_code)]

/// The candidate nearest to a mistyped name, by edit distance, if one is near enough to suggest.
pub fn nearest_name<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (strsim::levenshtein(name, candidate), candidate))
        .min()
        .filter(|(distance, candidate)| *distance <= 2.max(candidate.len() / 3))
        .map(|(_, candidate)| candidate)
}

/// `; did you mean 'x'?`, or the command that lists what there is.
pub fn did_you_mean<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
    list: &str,
) -> String {
    match nearest_name(name, candidates) {
        Some(near) => format!("; did you mean '{near}'?"),
        None => format!("; see `{list}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typing_error_finds_its_name() {
        let names = || ["moller-trumbore", "woop-watertight", "havel-herout"];
        assert_eq!(
            nearest_name("moler-trumbore", names()),
            Some("moller-trumbore")
        );
        assert_eq!(nearest_name("woop", names()), None);
        assert_eq!(nearest_name("havel-heruot", names()), Some("havel-herout"));
        assert_eq!(
            did_you_mean("woop", names(), "hairline list"),
            "; see `hairline list`"
        );
    }
}
