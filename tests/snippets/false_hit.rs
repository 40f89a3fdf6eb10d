/// half-space (edge=0), f64: false-hit of interior/front/within, without rounding too (convention).
/// Contract: ray, both sides, closed, coplanar free, degenerate free, invalid free.
#[test]
fn half_space_f64_false_hit() {
    use hairline::{Case, Scalar, Verdict, find, truth};
    let case = Case::<f64>::new([-0.1, 0.2, -1.0], [0.0, -0.0, -1.0], [[0.0, 0.0, 0.0], [0.001, 1e22, 0.0], [-1.0, 0.0, 0.0]]).on(-f64::INFINITY, 0.5);
    let kernel = f64::subject(find("half-space").unwrap()).unwrap();
    let mut verdict = [Verdict::miss(None)];
    kernel.run(&[case], &[0.0], &mut verdict);
    assert_eq!(truth(&case).to_string(), "transversal, front, t within, interior");
    // The contract asks a miss; the kernel hits.
    assert!(verdict[0].hit);
}
