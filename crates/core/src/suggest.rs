//! Floor 1: what to say about a mistyped name.

#![forbid(unsafe_code)]

/// The candidate nearest to a mistyped name, if one is near enough to suggest: a third of the letters may be wrong, and two
/// that changed places count once.
pub fn nearest_name<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (strsim::osa_distance(name, candidate), candidate))
        .min()
        .filter(|(distance, candidate)| *distance <= 1.max(name.len().min(candidate.len()) / 3))
        .map(|(_, candidate)| candidate)
}

/// The most names that an error lists.
const MOST: usize = 4;

/// The candidates of which a name is a part, between hyphens or at the start.
fn names_with_part<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    if name.is_empty() {
        return Vec::new();
    }
    candidates
        .into_iter()
        .filter(|candidate| {
            candidate.starts_with(name) || candidate.split(['-', ' ']).any(|part| part == name)
        })
        .collect()
}

/// `; did you mean 'x'?`, of several names if the word is a part of each, or the command that lists what there is.
pub fn did_you_mean<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
    list: &str,
) -> String {
    let candidates: Vec<&str> = candidates.into_iter().collect();
    let mut near = names_with_part(name, candidates.iter().copied());
    if near.is_empty() {
        near.extend(nearest_name(name, candidates));
    }
    let quoted: Vec<String> = near.iter().map(|name| format!("'{name}'")).collect();
    match &quoted[..] {
        [] => format!("; see `{list}`"),
        [one] => format!("; did you mean {one}?"),
        [others @ .., last] if others.len() < MOST => {
            format!("; did you mean {} or {last}?", others.join(", "))
        }
        all => format!(
            "; did you mean {} or another of `{list}`?",
            all[..MOST].join(", ")
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typing_error_finds_its_name() {
        let names = || ["moller-trumbore", "woop-watertight", "havel-herout", "huge"];
        assert_eq!(
            nearest_name("moler-trumbore", names()),
            Some("moller-trumbore")
        );
        assert_eq!(nearest_name("woop", names()), None);
        assert_eq!(nearest_name("edge", names()), None);
        assert_eq!(nearest_name("hgue", names()), Some("huge"));
        assert_eq!(nearest_name("hgeu", names()), None);
        assert_eq!(nearest_name("huges", names()), Some("huge"));
        assert_eq!(nearest_name("havel-heruot", names()), Some("havel-herout"));
    }

    #[test]
    fn a_part_of_a_name_finds_all_that_have_it() {
        let names = ["edge-near", "huge", "shared-edge", "edges"];
        let asked = |name| did_you_mean(name, names, "hairline list");
        assert_eq!(
            asked("edge"),
            "; did you mean 'edge-near', 'shared-edge' or 'edges'?"
        );
        assert_eq!(asked("hug"), "; did you mean 'huge'?");
        assert_eq!(asked("egde-near"), "; did you mean 'edge-near'?");
        assert_eq!(asked("woop"), "; see `hairline list`");
        assert_eq!(asked(""), "; see `hairline list`");
        let many = ["a-1", "a-2", "a-3", "a-4", "a-5"];
        assert_eq!(
            did_you_mean("a", many, "list a"),
            "; did you mean 'a-1', 'a-2', 'a-3', 'a-4' or another of `list a`?"
        );
    }
}
