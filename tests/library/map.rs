//! Maps pixel by pixel against direct evaluation, published pictures, and what is drawn read back.

use hairline::internals::arith::Float;
use hairline::internals::audit::{Row, Unobserved};
use hairline::internals::case::Case;
use hairline::internals::judge::Finding;
use hairline::internals::kernel::{Scalar, Verdict};
use hairline::internals::map::{
    self, CaseVector, Ink, Map, PixelStep, Spot, grid_of_case, of_kernel,
};
use hairline::internals::oracle;
use hairline::internals::truth::{Feature, Truth};

fn row(kernel: &str, epsilons: Option<&str>, contract: &str) -> Row {
    Row::named(kernel, epsilons, contract).unwrap()
}

/// The float so many bit patterns from a positive one.
fn neighbour<F: Float>(x: F, ulps: i64) -> F {
    assert!(x > F::zero());
    F::from_bits(x.to_bits().checked_add_signed(ulps).unwrap())
}

/// Each pixel again, alone: its case from bit patterns, its truth by the definition in rationals, its
/// finding by the words of the contract closed-line (a closed triangle on a whole line).
fn agrees_with_direct_evaluation<F: Scalar>(kernel: &str, spot: Spot) {
    let row = row(kernel, None, "closed-line");
    let (case, [width, height]) = (spot.case::<F>(), [23, 14]);
    let grid = grid_of_case(
        &case,
        CaseVector::Origin,
        Some([0, 1]),
        Some(PixelStep::Ulps(3)),
        [23, 14],
    );
    let map = of_kernel(&case, &row, &grid.unwrap(), &Unobserved).unwrap();
    let pixels = &map.pixels;
    assert_eq!(pixels.len(), width * height);
    for (index, pixel) in pixels.iter().enumerate() {
        let (x, y) = (index % width, height - 1 - index / width);
        let [mut origin, direction, a, b, c] = case.vectors();
        origin[0] = neighbour(origin[0], 3 * (x as i64 - 11));
        origin[1] = neighbour(origin[1], 3 * (y as i64 - 7));
        let case = Case::<F>::new(origin, direction, [a, b, c]);
        let mut verdict = [Verdict::miss(None)];
        F::subject(row.entry)
            .unwrap()
            .run(&[case], &row.epsilons::<F>(), &mut verdict);
        let truth = oracle::define(&case).truth;
        let Truth::Transversal(crossing) = truth else {
            panic!("{truth}")
        };
        let right = crossing.feature != Feature::Outside;
        let finding = match (right, verdict[0].hit) {
            (true, false) => Some(Finding::FalseMiss),
            (false, true) => Some(Finding::FalseHit),
            _ => None,
        };
        let on_boundary = crossing.feature.is_edge() || crossing.feature.is_vertex();
        let expected = (Some(verdict[0].hit), truth, on_boundary, finding);
        let found = (pixel.hit, pixel.truth, pixel.on_boundary, pixel.finding);
        assert_eq!(found, expected, "{kernel} {} {x},{y}", spot.name());
    }
}

#[test]
fn every_pixel_is_the_case_of_its_floats() {
    for spot in Spot::ALL {
        for kernel in [
            "moller-trumbore",
            "woop-watertight",
            "plane-inside-out",
            "cramer",
        ] {
            agrees_with_direct_evaluation::<f32>(kernel, spot);
            agrees_with_direct_evaluation::<f64>(kernel, spot);
        }
    }
}

#[test]
fn standard_cases_lie_on_what_they_are_called_by_in_both_scalars() {
    fn feature<F: Float>(spot: Spot) -> Feature {
        oracle::define(&spot.case::<F>())
            .truth
            .crossing()
            .unwrap()
            .feature
    }
    for (spot, expected) in [
        (Spot::Edge, Feature::EdgeAb),
        (Spot::Vertex, Feature::VertexC),
        (Spot::Grazing, Feature::EdgeAb),
    ] {
        assert_eq!(
            (feature::<f32>(spot), feature::<f64>(spot)),
            (expected, expected)
        );
    }
}

#[test]
fn standard_maps_show_every_kernel_beside_both_truths() {
    for kernel in hairline::internals::kernel::KERNELS {
        for spot in Spot::ALL {
            let map = map::standard::<f32>(&row(kernel.info.name, None, "own"), spot, [64, 64]);
            let map = map.unwrap();
            let count = |ink: Ink| {
                let legend = map.exact_legend();
                legend
                    .iter()
                    .find(|(other, ..)| *other == ink)
                    .map_or(0, |(_, _, count)| *count)
            };
            assert!(
                count(Ink::Yes) > 400 && count(Ink::No) > 400,
                "{} {spot:?}",
                map.subject
            );
            assert!(count(Ink::Boundary) > 0, "{} {spot:?}", map.subject);
        }
    }
}

/// Integers within 2^5: every product and sum of a triple product is exact in f32, so a test that
/// compares their signs is right everywhere.
#[test]
fn a_kernel_that_rounds_nowhere_has_no_wrong_pixel() {
    let case = Case::<f32>::new(
        [5.0, 4.0, 9.0],
        [1.0, -2.0, -3.0],
        [[-6.0, -7.0, 1.0], [19.0, -3.0, 2.0], [2.0, 15.0, -4.0]],
    );
    let step = Some(PixelStep::PowerOfTwo(0));
    let grid = grid_of_case(&case, CaseVector::Origin, Some([0, 1]), step, [48, 48]).unwrap();
    for kernel in ["scalar-triple", "scalar-triple-two-sided", "plucker"] {
        let map = of_kernel(&case, &row(kernel, None, "own"), &grid, &Unobserved).unwrap();
        assert_eq!(map.wrong(), 0, "{kernel}");
        let inks: Vec<Ink> = map.exact_legend().iter().map(|(ink, ..)| *ink).collect();
        assert_eq!(inks, [Ink::Yes, Ink::No, Ink::Boundary], "{kernel}");
    }
}

#[test]
fn exchanged_axes_transpose_the_map() {
    let (case, row) = (
        Spot::Edge.case::<f32>(),
        row("moller-trumbore", None, "own"),
    );
    let of = |coordinates, size| {
        let grid = grid_of_case(&case, CaseVector::B, Some(coordinates), None, size).unwrap();
        of_kernel(&case, &row, &grid, &Unobserved).unwrap()
    };
    let (plain, exchanged) = (of([0, 2], [20, 31]), of([2, 0], [31, 20]));
    assert!(plain.wrong() > 0);
    for x in 0..20 {
        for y in 0..31 {
            // From the top.
            let (one, other) = ((30 - y) * 20 + x, (19 - x) * 31 + y);
            assert_eq!(plain.pixels[one], exchanged.pixels[other], "{x},{y}");
        }
    }
}

#[test]
fn a_power_of_two_on_everything_leaves_the_map_alone() {
    let row = row("woop-watertight", None, "own");
    let map = |scale: f32| {
        let [o, d, a, b, c] = Spot::Edge
            .case::<f32>()
            .vectors()
            .map(|vector| vector.map(|x| x * scale));
        let case = Case::new(o, d, [a, b, c]);
        let grid = grid_of_case(&case, CaseVector::Origin, None, None, [40, 40]).unwrap();
        of_kernel(&case, &row, &grid, &Unobserved).unwrap()
    };
    assert_eq!(map(1.0).pixels, map(2f32.powi(12)).pixels);
    assert!(map(1.0).wrong() > 0);
}

#[test]
fn the_map_does_not_depend_on_the_number_of_threads() {
    let row = row("baldwin-weber", None, "own");
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| map::standard::<f32>(&row, Spot::Vertex, [50, 70]).unwrap())
    };
    assert_eq!(on(1), on(5));
}

#[test]
fn axes_lie_in_the_triangle_s_plane_and_a_zero_takes_larger_steps() {
    let triangle = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.5], [0.25, 0.0, 3.0]];
    let case = Case::<f64>::new([1.0, 0.0, 1.5], [-1.0, 0.0, 0.0], triangle);
    let grid = grid_of_case(&case, CaseVector::Origin, None, None, [3, 3]).unwrap();
    assert_eq!(grid.axes.map(|axis| axis.coordinate), [1, 2]);
    assert_eq!(
        grid.axes.map(|axis| axis.step),
        [PixelStep::PowerOfTwo(-52), PixelStep::Ulps(1)]
    );
    let values = grid
        .axes
        .map(|axis| [0, 1, 2].map(|pixel| axis.value(pixel)));
    let ulp = f64::EPSILON;
    assert_eq!(values, [[-ulp, 0.0, ulp], [1.5 - ulp, 1.5, 1.5 + ulp]]);
    // A point that is zero takes the steps of the largest coordinate; the centre stays as it is.
    let case = Case::<f32>::new([-0.0; 3], [1.0; 3], triangle.map(|p| p.map(|x| x as f32)));
    let grid = grid_of_case(&case, CaseVector::Origin, Some([2, 0]), None, [4, 4]).unwrap();
    assert_eq!(grid.axes[0].step, PixelStep::PowerOfTwo(-22));
    assert_eq!(grid.axes[0].value(2).to_bits(), (-0.0f32).to_bits());
    assert_eq!(grid.axes[0].value(0), -(2f32.powi(-21)));
}

#[test]
fn the_ends_of_the_range_are_free_and_no_panic() {
    let case = Case::<f32>::new(
        [f32::MAX, f32::NAN, 0.0],
        [0.0, 0.0, -1.0],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    );
    let grid = grid_of_case(&case, CaseVector::Origin, Some([0, 1]), None, [9, 5]).unwrap();
    let map = of_kernel(
        &case,
        &row("moller-trumbore", None, "own"),
        &grid,
        &Unobserved,
    )
    .unwrap();
    assert_eq!(map.exact_legend(), [(Ink::Free, "nothing is asked", 45)]);
    assert!(!map::svg(std::slice::from_ref(&map)).contains("NaN,"));
    let grid = grid_of_case(
        &case,
        CaseVector::Direction,
        None,
        Some(PixelStep::PowerOfTwo(1100)),
        [9, 5],
    );
    of_kernel(
        &case,
        &row("cramer", None, "own"),
        &grid.unwrap(),
        &Unobserved,
    )
    .unwrap();
}

#[test]
fn impossible_grids_are_refused() {
    let case = Spot::Edge.case::<f32>();
    let refused = |coordinates, step, size| {
        grid_of_case(&case, CaseVector::A, coordinates, step, size)
            .unwrap_err()
            .to_string()
    };
    assert!(refused(Some([1, 1]), None, [8, 8]).contains("two different"));
    assert!(refused(Some([1, 3]), None, [8, 8]).contains("3 coordinates"));
    assert!(refused(None, None, [0, 8]).contains("1 to 2048"));
    assert!(refused(None, None, [8, 2049]).contains("1 to 2048"));
    assert!(refused(None, Some(PixelStep::Ulps(0)), [8, 8]).contains("at least 1 ulp"));
}

fn vertex_map() -> Map {
    map::standard::<f32>(&row("moller-trumbore", None, "own"), Spot::Vertex, [48, 32]).unwrap()
}

#[test]
fn a_png_has_the_colours_of_both_panels() {
    let map = vertex_map();
    for scale in [1, 3] {
        let bytes = map::png(std::slice::from_ref(&map), scale).unwrap();
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut dots = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut dots).unwrap();
        let (wide, high) = (2 * 48 * scale + 8, 32 * scale);
        assert_eq!((info.width as usize, info.height as usize), (wide, high));
        assert_eq!(info.color_type, png::ColorType::Rgba);
        for (index, dot) in dots.chunks_exact(4).enumerate() {
            let (x, y) = (index % wide, index / wide);
            let pixel = |x: usize| y / scale * 48 + x / scale;
            let expected = if x < 48 * scale {
                Some(map.computed(pixel(x)))
            } else {
                x.checked_sub(48 * scale + 8).map(|x| map.exact(pixel(x)))
            };
            match expected {
                Some(ink) => assert_eq!(dot, [&ink.rgb()[..], &[255]].concat(), "{x},{y}"),
                None => assert_eq!(dot[3], 0, "{x},{y}"),
            }
        }
    }
    for scale in [0, 1 << 13, usize::MAX] {
        assert!(
            map::png(std::slice::from_ref(&map), scale)
                .unwrap_err()
                .to_string()
                .contains("2^26"),
            "{scale}"
        );
    }
}

/// The cells of a panel, read back from its paths of runs.
fn painted(panel: &str, [width, height]: [usize; 2]) -> Vec<String> {
    let mut cells = vec![String::new(); width * height];
    for path in panel.split("<path fill=\"").skip(1) {
        let (fill, rest) = path.split_once('"').unwrap();
        let data = rest
            .split_once("d=\"")
            .unwrap()
            .1
            .split_once('"')
            .unwrap()
            .0;
        for run in data.split_terminator('z') {
            let numbers: Vec<usize> = run
                .split(['M', ' ', 'h', 'v', '-'])
                .filter_map(|number| number.parse().ok())
                .collect();
            let [x, y, w, h, _] = numbers[..] else {
                panic!("{run}")
            };
            for y in y..y + h {
                cells[y * width + x..][..w].fill(fill.to_owned());
            }
        }
    }
    cells
}

#[test]
fn an_svg_paints_every_pixel_and_may_stand_beside_others_in_a_page() {
    let map = vertex_map();
    let svg = map::svg(std::slice::from_ref(&map));
    let panels: Vec<&str> = svg
        .split("shape-rendering=\"crispEdges\">")
        .skip(1)
        .collect();
    let [computed, exact] = panels[..] else {
        panic!("two panels")
    };
    for (panel, ink) in [
        (computed, &(|i| map.computed(i)) as &dyn Fn(usize) -> Ink),
        (exact, &|i| map.exact(i)),
    ] {
        let cells = painted(panel.split_once("</g>").unwrap().0, map.size());
        for (i, cell) in cells.iter().enumerate() {
            assert_eq!(*cell, ink(i).name(), "{i}");
        }
    }
    assert!(!svg.contains(" id=") && !svg.contains("<style") && !svg.contains("url("));
    assert!(svg.contains("<title>moller-trumbore (source) in f32"));
    assert!(svg.contains("<desc>A map of 48 by 32 pixels. moller-trumbore (source), "));
    assert!(map::svg_document(&[map]).contains("prefers-color-scheme"));
}

#[test]
fn right_inks_are_pale_and_wrong_ones_dark() {
    // Relative luminance, as WCAG 2 defines it: 3 to 1 is its least contrast of graphics.
    let luminance = |ink: Ink| {
        let linear = ink.rgb().map(|c| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    };
    let contrast = |a: Ink, b: Ink| (luminance(a) + 0.05) / (luminance(b) + 0.05);
    for right in [Ink::Yes, Ink::No, Ink::Boundary, Ink::Free] {
        for wrong in [Ink::FalseYes, Ink::FalseNo, Ink::Bad, Ink::Failed] {
            let least = if right == Ink::Yes && wrong == Ink::FalseYes {
                2.0
            } else {
                3.0
            };
            assert!(contrast(right, wrong) > least, "{right:?} {wrong:?}");
        }
    }
}
