//! Lists in sentences.

/// Names in a sentence; of many the first, and how many more there are.
pub fn listed(names: &[impl AsRef<str>], most: usize) -> String {
    let shown: Vec<&str> = names.iter().take(most).map(AsRef::as_ref).collect();
    match names.len().saturating_sub(most) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

/// Each thing with those after it that are like it.
pub fn alike<T>(
    all: impl IntoIterator<Item = T>,
    is_like: impl Fn(&T, &T) -> bool,
) -> Vec<(T, Vec<T>)> {
    let mut groups: Vec<(T, Vec<T>)> = Vec::new();
    for one in all {
        match groups.iter_mut().find(|(first, _)| is_like(first, &one)) {
            Some((_, like)) => like.push(one),
            None => groups.push((one, Vec::new())),
        }
    }
    groups
}
