(** proof.md, "How far a verdict can be wrong". *)
From Coq Require Import Reals Lra.
Open Scope R_scope.

(** A gate compares g, which is exactly l*s (l a barycentric coordinate), with e. *)
Section Gate.
Variables (l s g e beta sigma : R).
Hypothesis scale : 0 < sigma <= s.
Hypothesis error : Rabs (g - l * s) <= beta.

Lemma error2 : - beta <= g - l * s <= beta.
Proof. pose proof error. unfold Rabs in *. destruct Rcase_abs; lra. Qed.

Theorem miss : 0 <= l -> g < e -> l < (e + beta) / sigma.
Proof.
intros L G. pose proof error2.
apply Rmult_lt_reg_r with sigma; [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
assert (l * sigma <= l * s) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(** The bound without its maximum with 0. It needs e <= beta. *)
Theorem hit : e <= beta -> e <= g -> - ((beta - e) / sigma) <= l.
Proof.
intros E G. pose proof error2.
apply Rmult_le_reg_r with sigma; [lra |].
replace (- ((beta - e) / sigma) * sigma) with (e - beta) by (field; lra).
destruct (Rle_dec 0 l).
- assert (0 <= l * sigma) by (apply Rmult_le_pos; lra). lra.
- assert (l * s <= l * sigma) by (apply Rmult_le_compat_neg_l; lra). lra.
Qed.
(** As crates/prove/src/verdict.rs computes it. *)
Theorem hit_max : e <= g -> - Rmax ((beta - e) / sigma) 0 <= l.
Proof.
intros G. destruct (Rle_dec e beta) as [E | E].
- apply Rle_trans with (2 := hit E G). apply Ropp_le_contravar, Rmax_l.
- pose proof error2. assert (0 < l * s) by lra.
  assert (0 < l). { destruct (Rle_dec l 0); [| lra]. assert (l * s <= 0) by nra. lra. }
  pose proof (Rmax_r ((beta - e) / sigma) 0). lra.
Qed.
End Gate.

(** Without e <= beta the sentence is false: e = 2, beta = 1, sigma = 1, s = 4, l = 1/2, g = 2. *)
Theorem hit_needs_it : exists l s g e beta sigma,
  0 < sigma <= s /\ Rabs (g - l * s) <= beta /\ e <= g /\ l < - ((beta - e) / sigma).
Proof.
exists (/2), 4, 2, 2, 1, 1. repeat split; try lra.
replace (2 - /2 * 4) with 0 by lra. rewrite Rabs_R0. lra.
Qed.

(** A gate on 1 - l = the sum of the other two. *)
Theorem rest_miss x l1 l2 : l1 + l2 < x -> l1 < x / 2 \/ l2 < x / 2.
Proof. intros. destruct (Rlt_dec l1 (x / 2)); [auto | right; lra]. Qed.

(** Distances, in any norm of any real vector space. *)
Section Distance.
Variables (V : Type) (zero : V) (add : V -> V -> V) (mul : R -> V -> V) (norm : V -> R).
Notation "x +v y" := (add x y) (at level 50, left associativity).
Notation "c *v x" := (mul c x) (at level 40).
Hypothesis norm_add : forall x y, norm (x +v y) <= norm x + norm y.
Hypothesis norm_mul : forall c x, norm (c *v x) = Rabs c * norm x.

(** The edges b-a, c-a and c-b, none longer than len; a point is given by its weights. The difference of two points of
    weights l and m is (lb-mb)(b-a) + (lc-mc)(c-a). *)
Variables (ab ac : V) (len : R).
Hypothesis lab : norm ab <= len.
Hypothesis lac : norm ac <= len.
Hypothesis lbc : norm (ac +v (-1) *v ab) <= len.
Definition apart (lb lc mb mc : R) := (lb - mb) *v ab +v (lc - mc) *v ac.
(** b-a = (c-a) - (c-b): the same vector written from another vertex. *)
Hypothesis turn : forall x y, x *v ab +v y *v ac = (x + y) *v ac +v (- x) *v (ac +v (-1) *v ab).
Hypothesis turn' : forall x y, x *v ab +v y *v ac = (x + y) *v ab +v y *v (ac +v (-1) *v ab).

Hypothesis len0 : 0 <= len.

Lemma two x y p q : norm p <= len -> norm q <= len -> norm (x *v p +v y *v q) <= (Rabs x + Rabs y) * len.
Proof.
intros P Q. apply Rle_trans with (1 := norm_add _ _). rewrite !norm_mul, Rmult_plus_distr_r.
apply Rplus_le_compat; apply Rmult_le_compat_l; auto using Rabs_pos.
Qed.

Definition neg x := Rmax (- x) 0.

(** Outside by one weight, or beyond a vertex by two: some point of the triangle is at most that far. *)
Theorem outside la lb lc : la + lb + lc = 1 ->
  exists mb mc, 0 <= mb /\ 0 <= mc /\ mb + mc <= 1 /\
  norm (apart lb lc mb mc) <= (neg la + neg lb + neg lc) * len.
Proof.
intros S. unfold apart, neg.
assert (P : forall x, 0 <= x -> Rmax (- x) 0 = 0) by (intros; apply Rmax_right; lra).
assert (N : forall x, x <= 0 -> Rmax (- x) 0 = - x) by (intros; apply Rmax_left; lra).
destruct (Rle_dec 0 la) as [A | A], (Rle_dec 0 lb) as [B | B], (Rle_dec 0 lc) as [C | C];
  try (apply Rnot_le_lt in A); try (apply Rnot_le_lt in B); try (apply Rnot_le_lt in C); try lra.
- exists lb, lc. rewrite !P by lra. repeat split; try lra.
  apply Rle_trans with (1 := two _ _ _ _ lab lac). rewrite !Rminus_diag_eq, Rabs_R0 by reflexivity. lra.
- (* lc < 0: lb/(1-lc) of b *)
  exists (lb / (1 - lc)), 0. rewrite (P la), (P lb), (N lc) by lra.
  assert (Q : 0 <= lb / (1 - lc) <= 1).
  { split; [apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra] |].
    apply Rmult_le_reg_r with (1 - lc); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  repeat split; try lra. set (m := lb / (1 - lc)) in *.
  assert (M : lb = m * (1 - lc)) by (unfold m; field; lra).
  replace (lb - m) with (- lc * m) by (rewrite M; ring).
  replace (lc - 0) with lc by ring.
  rewrite turn. apply Rle_trans with (1 := two _ _ _ _ lac lbc). apply Rmult_le_compat_r; [assumption |].
  replace (- lc * m + lc) with (lc * (1 - m)) by ring.
  rewrite Rabs_Ropp, !Rabs_mult, Rabs_Ropp, (Rabs_left lc), (Rabs_pos_eq (1 - m)), (Rabs_pos_eq m) by lra. lra.
- (* lb < 0 *)
  exists 0, (lc / (1 - lb)). rewrite (P la), (P lc), (N lb) by lra.
  assert (Q : 0 <= lc / (1 - lb) <= 1).
  { split; [apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra] |].
    apply Rmult_le_reg_r with (1 - lb); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  repeat split; try lra. set (m := lc / (1 - lb)) in *.
  assert (M : lc = m * (1 - lb)) by (unfold m; field; lra).
  replace (lc - m) with (- lb * m) by (rewrite M; ring).
  replace (lb - 0) with lb by ring.
  rewrite turn'. apply Rle_trans with (1 := two _ _ _ _ lab lbc). apply Rmult_le_compat_r; [assumption |].
  replace (lb + - lb * m) with (lb * (1 - m)) by ring.
  rewrite !Rabs_mult, Rabs_Ropp, (Rabs_left lb), (Rabs_pos_eq (1 - m)), (Rabs_pos_eq m) by lra. lra.
- (* lb, lc < 0: a *)
  exists 0, 0. rewrite (P la), (N lb), (N lc) by lra. repeat split; try lra.
  rewrite !Rminus_0_r. apply Rle_trans with (1 := two _ _ _ _ lab lac).
  rewrite (Rabs_left lb), (Rabs_left lc) by lra. lra.
- (* la < 0 *)
  exists (lb / (1 - la)), (lc / (1 - la)). rewrite (N la), (P lb), (P lc) by lra.
  assert (Q : 0 <= lb / (1 - la)) by (apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra]).
  assert (Q' : 0 <= lc / (1 - la)) by (apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra]).
  assert (E : lb / (1 - la) + lc / (1 - la) = 1) by (replace lc with (1 - la - lb) by lra; field; lra).
  set (m := lb / (1 - la)) in *. set (k := lc / (1 - la)) in *.
  assert (M : lb = m * (1 - la)) by (unfold m; field; lra).
  assert (K : lc = k * (1 - la)) by (unfold k; field; lra).
  repeat split; try lra.
  replace (lb - m) with (- la * m) by (rewrite M at 1; ring).
  replace (lc - k) with (- la * k) by (rewrite K at 1; ring).
  apply Rle_trans with (1 := two _ _ _ _ lab lac). apply Rmult_le_compat_r; [assumption |].
  rewrite !Rabs_mult, Rabs_Ropp, (Rabs_left la), (Rabs_pos_eq m), (Rabs_pos_eq k) by lra. nra.
- (* la, lc < 0: b *)
  exists 1, 0. rewrite (N la), (P lb), (N lc) by lra. repeat split; try lra.
  rewrite Rminus_0_r, turn'. apply Rle_trans with (1 := two _ _ _ _ lab lbc).
  replace (lb - 1 + lc) with (- la) by lra. rewrite (Rabs_pos_eq (- la)), (Rabs_left lc) by lra. lra.
- (* la, lb < 0: c *)
  exists 0, 1. rewrite (N la), (N lb), (P lc) by lra. repeat split; try lra.
  rewrite Rminus_0_r, turn. apply Rle_trans with (1 := two _ _ _ _ lac lbc).
  replace (lb + (lc - 1)) with (- la) by lra. rewrite (Rabs_Ropp lb), (Rabs_pos_eq (- la)), (Rabs_left lb) by lra. lra.
Qed.
End Distance.
