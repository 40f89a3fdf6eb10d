//! The fast oracle against its definition, in both scalars.
#![cfg_attr(fuzzing, no_main)]

use hairline::oracle::{define, truth};

fn compare(data: &[u8]) {
    let narrow = hairline_fuzz::case::<f32>(data);
    assert_eq!(truth(&narrow), define(&narrow).truth, "{}", narrow.hex());
    let wide = hairline_fuzz::case::<f64>(data);
    assert_eq!(truth(&wide), define(&wide).truth, "{}", wide.hex());
}

hairline_fuzz::target!(compare);
