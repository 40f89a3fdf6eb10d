//! From bounds to sentences: which epsilons are proved to do what.

use super::claims;
use super::rounded::{above, below, degrees, signed, units};
use super::sizes::BySize;
use super::summary::{GateSummary, Summary, Witness};
use super::witness::Searched;
use super::{Assumption, Domain, Dyadic, Relative, Scene, Shape, Symmetry};
use crate::kernel::{Entry, Role, Scalar};

/// An epsilon, and where it comes from.
pub type Published = (String, f64);

/// A scene, and the triangles that it has.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The largest coordinate of the edges of its triangles, and twice their area: for each triangle of a mesh, or for
    /// the largest and the smallest of each kind that the scene may have.
    pub shapes: &'a [Shape],
}

/// The sentences about a gate; of each published epsilon it is said how far it carries.
pub fn statements<F: Searched + Scalar>(
    entry: &Entry,
    summary: &Summary<F>,
    gate: &GateSummary<F>,
    scene: Option<Triangles>,
    published: &[Published],
) -> Vec<String> {
    let bound = match &gate.bound {
        Ok(bound) => *bound,
        Err(why) => return vec![format!("No bound: {why}.")],
    };
    let beta = rounded_up(bound);
    let unit = summary.format.unit().to_f64();
    let in_units = |x: f64| format!("{} ({} u)", above(x), units(x / unit, true));
    let where_ = if scene.is_none() && gate.uses.floor {
        let Domain {
            floor, quotient, ..
        } = summary.domain;
        let inside = if gate.uses.inside {
            ", barycentric ones at least 0"
        } else {
            ""
        };
        format!(
            ", where divisors are at least {} and quotients at most {}{inside}",
            below(floor.to_f64()),
            above(quotient.to_f64())
        )
    } else {
        String::new()
    };
    // Sentences about epsilons begin with it: what follows from the bound holds where the bound does.
    let an = if where_.is_empty() {
        "An"
    } else {
        "With such divisors and quotients an"
    };
    let known = gate.witnesses[0]
        .as_ref()
        .map_or(String::new(), |Witness { score, .. }| {
            format!(
                "; {} ({} u) is known",
                below(*score),
                units(score / unit, false)
            )
        });
    let what = "What it compares is never wrong by more than";
    let mut lines = vec![format!("{what} {}{where_}{known}.", in_units(beta))];
    if scene.is_some() && !gate.limits.is_empty() {
        lines.push(supposed(&gate.limits));
    }
    if let Some(Relative {
        factor, underflow, ..
    }) = &gate.relative
    {
        lines.push(format!(
            "Where nothing overflows and no product or quotient underflows, it is wrong by at most {} u times its \
             permanent (the sum of the sizes of its terms), at any exponents. In {} it is, underflow or not, wrong by \
             at most that and {}; one that underflows beside larger numbers may cost more.",
            units(factor.to_f64() / unit, true),
            if scene.is_some() { "this scene" } else { "the unit domain" },
            above(rounded_up(*underflow))
        ));
    }
    let tunable = gate.gate.epsilon != crate::kernel::Tunable::Fixed;
    match gate.gate.role {
        _ if !gate.is_margin && !claims::compares_with_zero(summary, gate.index) => {}
        _ if !gate.is_margin => lines.push(format!(
            "{an} epsilon of 0 decides otherwise than exact arithmetic only where the exact number is within {} of 0.",
            above(beta)
        )),
        Role::Parallel if tunable && claims::is_zero_of_parallel_rays(summary, gate.index) => {
            let mut sizes = BySize::new::<F>(entry, gate.index);
            let own = sizes.as_mut().filter(|_| gate.uses.is_of_edges_alone());
            parallel(gate, scene, own, beta, an, published, &mut lines);
            let sizes =
                sizes.filter(|_| scene.is_none() && !gate.uses.floor && !gate.uses.extent);
            if let Some(mut sizes) = sizes {
                for epsilon in published.iter().filter(|(_, e)| *e > 0.0) {
                    lines.push(about_epsilon(entry, summary, gate, &mut sizes, epsilon));
                }
            }
        }
        Role::Edge if claims::loses_no_hit(entry, summary, gate.index) => lines.push(format!(
            "{an} epsilon below {} loses no hit at an edge.",
            signed(-beta, false)
        )),
        Role::Edge => {}
        _ if tunable => {
            lines.push(format!(
                "{an} epsilon below -{0} loses nothing that the exact formula accepts; one above {0} accepts nothing \
                 that it refuses.",
                above(beta)
            ));
            lines.extend(published.iter().map(|(name, value)| {
                format!(
                    "{an} epsilon of {name} refuses no exact value of {} and more, and accepts none of {} and less.",
                    signed((value + beta).next_up(), true),
                    signed((value - beta).next_down(), false)
                )
            }));
        }
        _ => {}
    }
    lines
}

/// A bound as a float that is not below it.
fn rounded_up(bound: Dyadic) -> f64 {
    let float = bound.round_up(f64::MANTISSA_DIGITS).to_f64();
    // Subnormal floats have fewer digits.
    if 0.0 < float && float < f64::MIN_POSITIVE {
        float.next_up()
    } else {
        float
    }
}

/// The limits that a bound in a scene supposes, and what the letters in them mean.
fn supposed(limits: &[Assumption]) -> String {
    let texts = limits.iter().map(
        |Assumption {
             is_most,
             name,
             limit,
         }| match is_most {
            true => format!("{name} at most {}", above(limit.to_f64())),
            false => format!("{name} at least {}", below(limit.to_f64())),
        },
    );
    let texts: Vec<String> = texts.collect();
    let has = |letter: &str| limits.iter().any(|limit| limit.name.contains(letter));
    let letters = [
        ("N", "N = (b-a)×(c-a)"),
        ("N_k", "N_k its largest coordinate"),
        ("d_k", "d_k the largest coordinate of d"),
        ("e_i", "e an edge"),
        ("p×q", "p and q vertices"),
        ("|u|", "u any barycentric coordinate, or 1 less it"),
    ];
    let letters: Vec<&str> = letters
        .into_iter()
        .filter(|(letter, _)| has(letter))
        .map(|(_, text)| text)
        .collect();
    let letters = if letters.is_empty() {
        String::new()
    } else {
        format!(" ({})", letters.join(", "))
    };
    format!(
        "It supposes of the exact numbers, and more of larger triangles: {}{letters}.",
        texts.join(", ")
    )
}

fn parallel<F: Searched + Scalar>(
    gate: &GateSummary<F>,
    scene: Option<Triangles>,
    own: Option<&mut BySize>,
    beta: f64,
    an: &str,
    published: &[Published],
    lines: &mut Vec<String>,
) {
    let passes = gate.witnesses[1]
        .as_ref()
        .filter(|witness| witness.score > 0.0);
    let known = passes.map_or(String::new(), |witness| {
        format!(
            " A parallel ray is known that reaches {}.",
            below(witness.score)
        )
    });
    lines.push(format!(
        "{an} epsilon above {} refuses every ray that is exactly parallel.{known}",
        above(beta)
    ));
    let Some(Triangles { shapes, scene }) = scene else {
        lines.push(format!(
            "{an} epsilon e refuses a hit only where the exact value is at most e + {}.",
            above(beta)
        ));
        return;
    };
    // Each triangle with its own bound, where the gate knows nothing but its edges.
    let mut errors = vec![beta; shapes.len()];
    if let Some(sizes) = own {
        for (error, (size, _)) in errors.iter_mut().zip(shapes) {
            *error = sizes
                .bound(*size)
                .map_or(beta, |bound| bound.to_f64().min(beta));
        }
    }
    let is_angle = gate.gate.dimension.length == 0;
    let is_mesh = scene.shape.is_some();
    let mut say = |name: &str, value: f64| {
        // |det| = 2 * area * |d| * sine of the angle to the plane.
        let sine = shapes
            .iter()
            .zip(&errors)
            .map(|((_, shape), error)| (value + error) / if is_angle { 1.0 } else { *shape });
        let sine = sine.fold(0.0, f64::max);
        let cost = if sine < 1.0 {
            let angle = libm::asin(sine).to_degrees();
            format!(
                "it keeps every hit at {} to the plane and more",
                degrees(angle)
            )
        } else {
            "for no angle is it proved that every hit is kept".to_owned()
        };
        let refuses = match errors.iter().filter(|error| **error < value).count() {
            proved if beta < value || 0 < proved && proved == shapes.len() => {
                "refuses every parallel ray".to_owned()
            }
            0 => "is not proved to refuse parallel rays".to_owned(),
            // The shapes of a mesh are its triangles, those of other scenes sizes, the smallest first.
            proved if is_mesh => format!(
                "is proved to refuse the parallel rays of {proved} of {} triangles only",
                shapes.len()
            ),
            proved => format!(
                "is proved to refuse the parallel rays of triangles with edges up to {} only",
                below(shapes[proved - 1].0)
            ),
        };
        lines.push(format!(
            "In this scene, for |d| = 1, {name} {refuses}; {cost}."
        ));
    };
    // Above the number that was printed.
    let printed: f64 = above(beta).parse().expect("a number as it is printed");
    say("that epsilon", printed.next_up());
    for (name, value) in published.iter().filter(|(_, e)| *e > 0.0) {
        say(&format!("e = {name}"), *value);
    }
}

/// How far one published epsilon carries.
fn about_epsilon<F: Searched + Scalar>(
    entry: &Entry,
    summary: &Summary<F>,
    gate: &GateSummary<F>,
    sizes: &mut BySize,
    (name, value): &Published,
) -> String {
    let (uses, domain) = (gate.uses, &summary.domain);
    let all = [
        (uses.edge, "edges", domain.edge),
        (
            uses.reach,
            "vectors from the origin to the vertices",
            domain.reach,
        ),
        (uses.world, "points", domain.world),
    ];
    let used = all.into_iter().filter(|(is_used, ..)| *is_used);
    let names: Vec<&str> = used.clone().map(|(_, name, _)| name).collect();
    let what = names.join(" and of ");
    let proved = sizes.largest(F::from_f64(*value).to_f64()).map_or_else(
        || format!("e = {name} is proved for no size of {what}."),
        |size| {
            format!(
                "e = {name} is proved to refuse every parallel ray where coordinates of {what} are at most {}.",
                below(size.to_f64())
            )
        },
    );
    // Unless a product underflows, a power of two changes no rounding: the known case is run again at that size.
    let passes = gate.witnesses[1]
        .as_ref()
        .map(|witness| witness.score)
        .filter(|x| *x > 0.0);
    let length = gate.gate.dimension.length;
    let fails = passes.filter(|_| length > 0).and_then(|score| {
        let bounds = used.map(|(.., bound)| bound.to_f64());
        let bound = bounds.fold(0.0, f64::max);
        let exponent = ((value / score).log2() / f64::from(length)).floor() as i32 + 1;
        let size = bound * 2f64.powi(exponent);
        claims::passes_scaled(entry, gate, exponent, *value).then(|| {
            format!(
                " A known parallel ray passes it where they are up to {}.",
                above(size)
            )
        })
    });
    format!("{proved}{}", fails.unwrap_or_default())
}

/// The statement that follows from the symmetry of the edge values.
pub fn about_edges(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::None => {
            "Watertight: not proved. The two triangles of an edge may compute two values of the same sign, and \
             both refuse the ray."
        }
        Symmetry::Negatives => {
            "At an epsilon of 0 or less two consistently wound triangles never both refuse a ray for the edge that \
             they share, unless something overflows: their values are opposite, or 0. Another edge or gate may still \
             refuse it, so rays may slip through at vertices. Folds (silhouettes) are not covered."
        }
        Symmetry::ExactSigns => {
            "Watertight at its edges at an epsilon of 0 or less, proved short of overflow and underflow. For each ray \
             the kernel moves every vertex to a rounded point of a plane, the same point for all triangles. No edge \
             value has the wrong sign there, though it may be 0. So the edge gate accepts every triangle of rounded \
             points that the ray meets, its edges included: two consistently wound triangles never both refuse a ray \
             for the edge that they share, and of a mesh or a closed fan some triangle is accepted, if the rounded \
             points leave no gap and no fold where the ray passes. Folds (silhouettes) are not covered. Other gates \
             may still refuse: one of the determinant a triangle whose three edge values are all rounded to 0, t near \
             t_min or t_max."
        }
    }
}
