/// moller-trumbore (parallel=1e-6,edge=0), f32: false-miss of interior/front/within, refused by 'parallel', without rounding too (epsilon).
/// Contract: line, both sides, closed, coplanar miss, degenerate miss, invalid free.
#[test]
fn moller_trumbore_f32_false_miss() {
    use hairline::{Case, Scalar, Verdict, find, truth};
    let case = Case::<f32>::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [[0.0, 0.0, 1.0], [0.0, 9.536743e-7, -1.0], [0.0, -1.4901161e-8, 0.0]]);
    let kernel = f32::subject(find("moller-trumbore").unwrap()).unwrap();
    let mut verdict = [Verdict::miss(None)];
    kernel.run(&[case], &[1e-6, 0.0], &mut verdict);
    assert_eq!(truth(&case).to_string(), "transversal, front, t at_min, interior");
    // The contract asks a hit; the kernel misses.
    assert!(!verdict[0].hit);
}
