//! A C header: an array of structures, a row a triangle.

use super::number::nearest;
use super::{Test, word};

/// The text before the rows; `digest` is that of the core set, or a word for another set.
pub fn head(digest: &str) -> String {
    format!(
        "/* Ray-triangle test vectors. CC0-1.0. Every number is a bit pattern: memcpy it to a double, or its low
   half to a float. A group has a row for each triangle; compare the number of hits with `group`. */
#ifndef RAY_TRIANGLE_VECTORS_H
#define RAY_TRIANGLE_VECTORS_H
#include <stdint.h>
#define RAY_TRIANGLE_VECTORS_SHA256 \"{digest}\"
struct ray_triangle_vector {{
    const char *id;
    int triangle, triangles, scalar;   /* which of the test's triangles, of how many; 32 or 64 */
    uint64_t origin[3], direction[3], t_min, t_max, a[3], b[3], c[3];
    const char *result, *closed, *open; /* hit, miss or free */
    const char *free_because;           /* what a profile answers, words between spaces: boundary, ends, ... */
    const char *group, *parity;         /* exactly-one, at-least-one, free; even, odd; empty: no group */
    const char *where, *place, *facing; /* interior, edge_ab, ..., parallel, coplanar, ...; within, ...; front, back */
    double t, u, v, margin;             /* rounded; 0 if `where` is a class without a point */
    const char *flags;                  /* what may go wrong, words between spaces */
}};
static const struct ray_triangle_vector ray_triangle_vectors[] = {{
"
    )
}

/// The text behind the rows.
pub const TAIL: &str = "};\n#endif\n";

/// The rows of a test.
pub fn rows(test: &Test) -> String {
    let mut text = String::new();
    for (i, triangle) in test.triangles.iter().enumerate() {
        let numbers = test.ray.iter().chain(&triangle.numbers);
        let bits: Vec<String> = numbers.map(|number| format!("0x{:x}", number.pattern)).collect();
        let vector = |at: usize| format!("{{{}}}", bits[at..at + 3].join(","));
        let values = [0, 1, 2, 3].map(|i| match &triangle.values {
            Some(values) => double(nearest(&values[i])),
            None => "0".to_owned(),
        });
        let crossing = triangle.truth.crossing();
        let words = [
            word(triangle.result()),
            word(triangle.closed()),
            word(triangle.open()),
            &triangle.free_because().join(" "),
            test.group.map_or("", |group| group.result()),
            test.group.map_or("", |group| group.parity()),
            triangle.place(),
            crossing.map_or("", |crossing| crossing.place.name()),
            crossing.map_or("", |crossing| crossing.facing.name()),
        ];
        text.push_str(&format!(
            "{{\"{}\",{i},{},{},{},{},{},{},{},{},{},{},{},\"{}\"}},\n",
            test.id,
            test.triangles.len(),
            &test.scalar[1..],
            vector(0),
            vector(3),
            bits[6],
            bits[7],
            vector(8),
            vector(11),
            vector(14),
            words.map(|word| format!("\"{word}\"")).join(","),
            values.join(","),
            test.flags.join(" "),
        ));
    }
    text
}

fn double(value: f64) -> String {
    if value.is_finite() {
        return format!("{value:e}");
    }
    // No compiler warns about this overflow, which HUGE_VAL would need a header for.
    format!("{}1e308*10", if value < 0.0 { "-" } else { "" })
}
