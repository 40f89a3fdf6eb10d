//! Drawings read back: places against geometry worked out by hand, and numbers that are numbers for
//! every family.

use hairline::internals::audit::Row;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::Scalar;
use hairline::internals::map;

fn drawn<F: Scalar>(case: &Case<F>, kernel: &str) -> String {
    map::drawing(case, &Row::named(kernel, None, "own").unwrap()).unwrap()
}

/// The values of an attribute, in order.
fn attributes<'a>(svg: &'a str, name: &str) -> Vec<&'a str> {
    let start = format!(" {name}=\"");
    svg.split(start.as_str())
        .skip(1)
        .map(|rest| rest.split_once('"').unwrap().0)
        .collect()
}

/// The numbers of some text.
fn numbers(text: &str) -> Vec<f64> {
    let is_part = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    text.split(|c| !is_part(c))
        .filter(|n| !n.is_empty())
        .map(|n| n.parse().unwrap())
        .collect()
}

/// The strokes of two points from M to L, as x1, y1, x2, y2.
fn strokes(svg: &str, mark: &str) -> Vec<[f64; 4]> {
    svg.lines()
        .filter(|line| line.contains("<path d=\"M") && line.contains(mark))
        .map(|line| numbers(attributes(line, "d")[0]).try_into().unwrap())
        .collect()
}

/// The places of the exact mark, panel by panel.
fn exact_marks(svg: &str) -> Vec<[f64; 2]> {
    svg.lines()
        .filter(|line| line.contains("<circle") && line.contains("r=\"3.5\""))
        .map(|line| [attributes(line, "cx")[0], attributes(line, "cy")[0]])
        .map(|place| place.map(|number| number.parse().unwrap()))
        .collect()
}

/// The distance of a point from the line of a stroke.
fn distance([x1, y1, x2, y2]: [f64; 4], [x, y]: [f64; 2]) -> f64 {
    let (dx, dy) = (x2 - x1, y2 - y1);
    ((x - x1) * dy - (y - y1) * dx).abs() / dx.hypot(dy)
}

#[test]
fn the_triangle_and_the_point_have_their_shape() {
    // Legs 4 and 3; onto (1, 1), which is at 1 from all three edges.
    let triangle = [[0.0, 0.0, 7.0], [4.0, 0.0, 7.0], [0.0, 3.0, 7.0]];
    let svg = drawn(
        &Case::<f64>::new([1.0, 1.0, 9.0], [0.0, 0.0, -1.0], triangle),
        "cramer",
    );
    let edges = strokes(&svg, "stroke-width=\"2\"");
    let [ab, bc, ca] = edges[..] else {
        panic!("one panel: {edges:?}")
    };
    let length = |[x1, y1, x2, y2]: [f64; 4]| (x2 - x1).hypot(y2 - y1);
    let unit = length(bc) / 5.0;
    assert!((length(ab) - 4.0 * unit).abs() < 0.03 && (length(ca) - 3.0 * unit).abs() < 0.03);
    let marks = exact_marks(&svg);
    // The last one is the key's.
    assert_eq!(marks.len(), 2);
    for edge in [ab, bc, ca] {
        assert!((distance(edge, marks[0]) - unit).abs() < 0.03);
    }
    // From its front a, b, c run counter-clockwise: in a drawing, where y points down, the other way.
    let turn = (ab[2] - ab[0]) * (bc[3] - bc[1]) - (ab[3] - ab[1]) * (bc[2] - bc[0]);
    assert!(turn < 0.0);
}

#[test]
fn an_inset_keeps_its_digits_however_near_the_edge_is() {
    for power in [-8, -30, -52, -200, -900] {
        // 2^power inside of the edge from (0, 0, 0) to (8, 0, 0), and 8 long.
        let gap = 2f64.powi(power);
        let triangle = [[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [4.0, 4.0, 0.0]];
        let case = Case::<f64>::new([3.0, gap, 1.0], [0.0, 0.0, -1.0], triangle);
        let svg = drawn(&case, "scalar-triple");
        let edges = strokes(&svg, "stroke-width=\"2\"");
        let (inset, marks) = (edges[3], exact_marks(&svg));
        assert_eq!((edges.len(), marks.len()), (4, 3), "2^{power}");
        // The inset shows 2.5 times the distance on each side of its middle, 149 dots.
        assert_eq!(marks[1], [640.0 - 14.0 - 149.0, 52.0 + 149.0], "2^{power}");
        assert!(
            (distance(inset, marks[1]) - 149.0 / 2.5).abs() < 0.02,
            "2^{power}"
        );
        // The inside is the upper part.
        assert!(inset[1] > marks[1][1], "2^{power}");
        let zoom = svg
            .split("the point, ")
            .nth(1)
            .unwrap()
            .split_once(" times")
            .unwrap()
            .0;
        // The overview's half is 0.64 longest edges; those are 8.
        let expected = 0.64 * 8.0 / (2.5 * gap);
        assert!(
            (zoom.parse::<f64>().unwrap() / expected - 1.0).abs() < 6e-3,
            "{zoom} {expected:e}"
        );
    }
}

#[test]
fn a_wrong_t_is_drawn_where_it_points() {
    // Along (1, 0, -1) onto (2, 1, 0), where t is 4; a kernel that says 4.5 means (2.5, 1) in the plane.
    use hairline::internals::contract::Contract;
    use hairline::internals::kernel::{Entry, Hit, KernelInfo, register};
    const INFO: KernelInfo = KernelInfo::own("half-too-far", Contract::CLOSED_RAY);
    register(Entry::new(&INFO).f64(|_: &Case<f64>, _: &[f64]| Some(Hit::at(4.5)))).unwrap();
    let triangle = [[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let case = Case::<f64>::new([-2.0, 1.0, 4.0], [1.0, 0.0, -1.0], triangle);
    let svg = drawn(&case, "half-too-far");
    let unit = {
        let [x1, y1, x2, y2] = strokes(&svg, "stroke-width=\"2\"")[0];
        (x2 - x1).hypot(y2 - y1) / 8.0
    };
    let cross = svg
        .lines()
        .find(|line| line.contains("l11 11m0 -11l-11 11"))
        .unwrap();
    let corner = numbers(attributes(cross, "d")[0]);
    let cross = [corner[0] + 5.5, corner[1] + 5.5];
    let exact = exact_marks(&svg)[0];
    assert!(((cross[0] - exact[0]).hypot(cross[1] - exact[1]) - 0.5 * unit).abs() < 0.03);
    // 0.5·√2 of the longest edge, √80.
    assert!(
        svg.contains("The kernel's point is 7.906e-2 longest edges from the exact one."),
        "{svg}"
    );
}

/// Every number of the drawing is one, and within it.
fn is_sound(svg: &str, what: &str) {
    let height = numbers(attributes(svg, "viewBox")[0])[3];
    for name in ["x", "y", "cx", "cy", "width", "height"] {
        for value in attributes(svg, name)
            .into_iter()
            .filter(|value| *value != "100%")
        {
            let number: f64 = value.parse().unwrap_or(f64::NAN);
            assert!(
                (0.0..=height.max(640.0)).contains(&number),
                "{what}: {name}={value}"
            );
        }
    }
    for data in attributes(svg, "d") {
        assert!(
            !data.contains("NaN") && !data.contains("inf"),
            "{what}: {data}"
        );
        for number in numbers(data) {
            assert!(
                (-20.0..=height.max(640.0)).contains(&number),
                "{what}: {data}"
            );
        }
    }
    assert!(!svg.contains(" id=") && !svg.contains("<style"), "{what}");
    let opened = svg.matches("<text").count();
    assert_eq!(opened, svg.matches("</text>").count(), "{what}");
}

fn draws_every_family<F: Scalar>(kernels: &[&str]) {
    for family in FAMILIES {
        for index in 0..12 {
            for (k, case) in family
                .make::<F>(&Parameters::default(), 3, index)
                .cases()
                .iter()
                .enumerate()
            {
                for kernel in kernels {
                    let svg = drawn(case, kernel);
                    is_sound(
                        &svg,
                        &format!("{} {} {index}.{k} {kernel}", family.name, F::NAME),
                    );
                }
            }
        }
    }
}

#[test]
fn every_family_is_drawn_with_sound_numbers() {
    draws_every_family::<f32>(&["moller-trumbore", "havel-herout"]);
    draws_every_family::<f64>(&["moller-trumbore", "plucker"]);
}

#[test]
fn what_has_no_place_is_said_and_not_drawn() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let of = |origin, direction, triangle| {
        let svg = drawn(
            &Case::<f64>::new(origin, direction, triangle),
            "moller-trumbore",
        );
        is_sound(&svg, "");
        svg
    };
    let nan = of([f64::NAN, 0.0, 0.0], [0.0, 0.0, 1.0], triangle);
    assert!(nan.contains("A coordinate is not finite: there is nothing to draw."));
    let still = of([0.0; 3], [0.0; 3], triangle);
    assert!(still.contains("there is no line to draw"));
    let point = of([3.0, 0.0, 1.0], [0.0, 0.0, -1.0], [[1.0; 3]; 3]);
    assert!(
        point.contains("The triangle has no area; seen along the ray.")
            && point.contains("a = b = c")
    );
    // The line is seen as a point, and only the segment as a line.
    let aslant = of(
        [3.0, 0.0, 1.0],
        [1.0, 2.0, -1.0],
        [[0.0; 3], [1.0; 3], [2.0; 3]],
    );
    assert!(aslant.contains("seen along the ray") && strokes(&aslant, "dasharray").is_empty());
    let along = of([-1.0; 3], [1.0; 3], [[0.0; 3], [1.0; 3], [2.0; 3]]);
    assert!(along.contains("seen from aside") && along.contains("thick: in the triangle"));
    let huge = of([1e308, 1e308, 1e308], [-1e-308, 0.0, -1e308], triangle);
    assert!(huge.contains("Exactly: transversal"));
}
