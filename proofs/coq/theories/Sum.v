(** proof.md, "Formulas without divisions": the rule of sums of products. *)
From Coq Require Import ZArith Reals Lia Lra List FunctionalExtensionality Arith.
From Flocq Require Import Core.
From Hairline Require Import Rounding.
Open Scope R_scope.

(** A formula. [Step k e] is step k: e, with an error of its own. Equal numbers are the same (shared) step. *)
Inductive expr :=
  | Var (i : nat) | Num (c : R)
  | Add (a b : expr) | Sub (a b : expr) | Mul (a b : expr) | Neg (a : expr)
  | Step (k : nat) (e : expr).

Definition env := nat -> R.
Definition upd (v : env) (i : nat) (x : R) : env := fun j => if Nat.eqb j i then x else v j.

Fixpoint ex (v : env) (e : expr) : R := match e with
  | Var i => v i | Num c => c
  | Add a b => ex v a + ex v b | Sub a b => ex v a - ex v b | Mul a b => ex v a * ex v b | Neg a => - ex v a
  | Step _ e => ex v e end.

(** Computed: each step makes its error. *)
Fixpoint cv (v dl : env) (e : expr) : R := match e with
  | Var i => v i | Num c => c
  | Add a b => cv v dl a + cv v dl b | Sub a b => cv v dl a - cv v dl b | Mul a b => cv v dl a * cv v dl b
  | Neg a => - cv v dl a
  | Step k e => cv v dl e + dl k end.

(** The derivative by step k, or that times the step. *)
Fixpoint G (rel : bool) (k : nat) (v : env) (e : expr) : R := match e with
  | Var _ | Num _ => 0
  | Add a b => G rel k v a + G rel k v b | Sub a b => G rel k v a - G rel k v b | Neg a => - G rel k v a
  | Mul a b => G rel k v a * ex v b + ex v a * G rel k v b
  | Step j e => (if Nat.eqb j k then if rel then ex v e else 1 else 0) + G rel k v e end.

(** The first order. *)
Fixpoint L (v d1 : env) (e : expr) : R := match e with
  | Var _ | Num _ => 0
  | Add a b => L v d1 a + L v d1 b | Sub a b => L v d1 a - L v d1 b | Neg a => - L v d1 a
  | Mul a b => L v d1 a * ex v b + ex v a * L v d1 b
  | Step k e => L v d1 e + d1 k end.

Fixpoint dep (i : nat) (e : expr) : Prop := match e with
  | Var j => i = j | Num _ => False
  | Add a b | Sub a b | Mul a b => dep i a \/ dep i b
  | Neg a | Step _ a => dep i a end.

(** Factors have no variable in common. *)
Fixpoint apart (e : expr) : Prop := match e with
  | Var _ | Num _ => True
  | Add a b | Sub a b => apart a /\ apart b
  | Mul a b => apart a /\ apart b /\ forall i, dep i a -> dep i b -> False
  | Neg a | Step _ a => apart a end.

(** Equal numbers are equal steps, and there are fewer than n. *)
Fixpoint shared (n : nat) (body : nat -> expr) (e : expr) : Prop := match e with
  | Var _ | Num _ => True
  | Add a b | Sub a b | Mul a b => shared n body a /\ shared n body b
  | Neg a => shared n body a
  | Step k a => (k < n)%nat /\ a = body k /\ shared n body a end.

Fixpoint sum (n : nat) (f : nat -> R) : R := match n with O => 0 | S n => sum n f + f n end.
Lemma sum_ext n f g : (forall k, (k < n)%nat -> f k = g k) -> sum n f = sum n g.
Proof. induction n; intros E; simpl; [reflexivity |]. rewrite IHn, E by (intros; try apply E; lia). reflexivity. Qed.
Lemma sum_plus n f g : sum n (fun k => f k + g k) = sum n f + sum n g.
Proof. induction n; simpl; [ring | rewrite IHn; ring]. Qed.
Lemma sum_scal n f c : sum n (fun k => c * f k) = c * sum n f.
Proof. induction n; simpl; [ring | rewrite IHn; ring]. Qed.
Lemma sum_le n f g : (forall k, (k < n)%nat -> f k <= g k) -> sum n f <= sum n g.
Proof. induction n; intros E; simpl; [lra |]. apply Rplus_le_compat; [apply IHn; intros |]; apply E; lia. Qed.
Lemma sum_abs n f : Rabs (sum n f) <= sum n (fun k => Rabs (f k)).
Proof. induction n; simpl; [rewrite Rabs_R0; lra |]. apply Rle_trans with (1 := Rabs_triang _ _). lra. Qed.
Lemma sum_zero n : sum n (fun _ => 0) = 0.
Proof. induction n; simpl; [reflexivity | rewrite IHn; ring]. Qed.
Lemma sum_one n j x : (j < n)%nat -> sum n (fun k => if Nat.eqb j k then x k else 0) = x j.
Proof.
induction n; intros J; [lia |]. simpl. destruct (Nat.eq_dec j n) as [-> | N].
- rewrite Nat.eqb_refl. rewrite (sum_ext n _ (fun _ => 0)). { rewrite sum_zero. ring. }
  intros k K. destruct (Nat.eqb_spec n k); [lia | reflexivity].
- rewrite IHn by lia. destruct (Nat.eqb_spec j n); [lia | ring].
Qed.

Lemma L_sum n body v d1 e : shared n body e -> L v d1 e = sum n (fun k => G false k v e * d1 k).
Proof.
induction e; simpl; intros W.
1,2: rewrite (sum_ext n _ (fun _ => 0)) by (intros; ring); rewrite sum_zero; reflexivity.
- destruct W. rewrite IHe1, IHe2, <- sum_plus by assumption. apply sum_ext; intros; ring.
- destruct W. rewrite IHe1, IHe2 by assumption.
  rewrite (sum_ext n (fun k => (G false k v e1 - G false k v e2) * d1 k)
    (fun k => G false k v e1 * d1 k + (-1) * (G false k v e2 * d1 k))) by (intros; ring).
  rewrite sum_plus, sum_scal. ring.
- destruct W. rewrite IHe1, IHe2 by assumption.
  rewrite (sum_ext n (fun k => (G false k v e1 * ex v e2 + ex v e1 * G false k v e2) * d1 k)
    (fun k => ex v e2 * (G false k v e1 * d1 k) + ex v e1 * (G false k v e2 * d1 k))) by (intros; ring).
  rewrite sum_plus, !sum_scal. ring.
- rewrite IHe by assumption.
  rewrite (sum_ext n (fun k => - G false k v e * d1 k) (fun k => (-1) * (G false k v e * d1 k))) by (intros; ring).
  rewrite sum_scal. ring.
- destruct W as (K & _ & W). rewrite IHe by assumption. rewrite <- (sum_one n k d1 K), <- sum_plus.
  apply sum_ext; intros j _. destruct (Nat.eqb k j); ring.
Qed.

Lemma G_relative n body k v e : shared n body e -> G true k v e = G false k v e * ex v (body k).
Proof.
induction e; simpl; intros W; try ring.
- destruct W. rewrite IHe1, IHe2 by assumption. ring.
- destruct W. rewrite IHe1, IHe2 by assumption. ring.
- destruct W. rewrite IHe1, IHe2 by assumption. ring.
- rewrite IHe by assumption. ring.
- destruct W as (K & E & W). rewrite IHe by assumption.
  destruct (Nat.eqb_spec k0 k); [subst | ]; ring.
Qed.

(** ** Orders *)
Section Orders.
Variables (n : nat) (body : nat -> expr) (u tau : R).
Hypothesis u0 : 0 <= u.
Hypothesis tau0 : 0 <= tau.
(** Sizes of variables and of steps; bounds of the steps' errors; which are relative. *)
Variables (m s h : nat -> R) (rel : nat -> bool).

Fixpoint sz (e : expr) : R := match e with
  | Var i => m i | Num c => Rabs c
  | Add a b | Sub a b => sz a + sz b | Mul a b => sz a * sz b | Neg a => sz a
  | Step k _ => s k end.

Fixpoint FO (e : expr) : R := match e with
  | Var _ | Num _ => 0
  | Add a b | Sub a b => FO a + FO b | Neg a => FO a
  | Mul a b => sz a * FO b + FO a * sz b
  | Step k e => FO e + (if rel k then u * s k else h k) end.

Fixpoint HO (e : expr) : R := match e with
  | Var _ | Num _ => 0
  | Add a b | Sub a b => HO a + HO b | Neg a => HO a
  | Mul a b => FO a * FO b + HO a * (sz b + FO b + HO b) + (sz a + FO a) * HO b
  | Step k e => HO e + (if rel k then u * (FO e + HO e) + tau else 0) end.

Variables (v dl : env).
Hypothesis box : forall i, Rabs (v i) <= m i.
Hypothesis sizes : forall k, Rabs (ex v (body k)) <= s k.

(** What is known of the errors. *)
Fixpoint errors (e : expr) : Prop := match e with
  | Var _ | Num _ => True
  | Add a b | Sub a b | Mul a b => errors a /\ errors b | Neg a => errors a
  | Step k a => errors a /\ if rel k then Rabs (dl k) <= u * Rabs (cv v dl a) + tau else Rabs (dl k) <= h k end.

(** The part of an error that is of first order. *)
Definition w (k : nat) := if rel k then u * Rabs (ex v (body k)) else h k.
Definition d1 (k : nat) := if rel k then Rmax (- w k) (Rmin (w k) (dl k)) else dl k.

Lemma size_ok e : shared n body e -> Rabs (ex v e) <= sz e.
Proof.
induction e; simpl; intros W.
- apply box.
- lra.
- destruct W. apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat; auto.
- destruct W. unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. apply Rplus_le_compat; auto.
- destruct W. rewrite Rabs_mult. apply Rmult_le_compat; auto; apply Rabs_pos.
- rewrite Rabs_Ropp. auto.
- destruct W as (_ & -> & _). apply sizes.
Qed.

Lemma clamp a x y : 0 <= a -> 0 <= y -> Rabs x <= a + y ->
  Rabs (Rmax (- a) (Rmin a x)) <= a /\ Rabs (x - Rmax (- a) (Rmin a x)) <= y.
Proof.
intros A Y X. unfold Rmax, Rmin, Rabs in *.
repeat (destruct Rle_dec || destruct Rcase_abs); split; lra.
Qed.

Theorem orders e : shared n body e -> errors e ->
  Rabs (L v d1 e) <= FO e /\ Rabs (cv v dl e - ex v e - L v d1 e) <= HO e.
Proof.
induction e; simpl; intros W E.
- replace (v i - v i - 0) with 0 by ring. rewrite Rabs_R0. lra.
- replace (c - c - 0) with 0 by ring. rewrite Rabs_R0. lra.
- destruct W, E. destruct IHe1 as [A1 B1], IHe2 as [A2 B2]; try assumption. split.
  + apply Rle_trans with (1 := Rabs_triang _ _). lra.
  + replace (cv v dl e1 + cv v dl e2 - (ex v e1 + ex v e2) - (L v d1 e1 + L v d1 e2))
    with ((cv v dl e1 - ex v e1 - L v d1 e1) + (cv v dl e2 - ex v e2 - L v d1 e2)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra.
- destruct W, E. destruct IHe1 as [A1 B1], IHe2 as [A2 B2]; try assumption. split.
  + unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra.
  + replace (cv v dl e1 - cv v dl e2 - (ex v e1 - ex v e2) - (L v d1 e1 - L v d1 e2))
    with ((cv v dl e1 - ex v e1 - L v d1 e1) + - (cv v dl e2 - ex v e2 - L v d1 e2)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra.
- destruct W as [W1 W2], E as [E1 E2].
  destruct IHe1 as [A1 B1], IHe2 as [A2 B2]; try assumption.
  pose proof (size_ok e1 W1) as S1. pose proof (size_ok e2 W2) as S2.
  set (a := ex v e1) in *. set (b := ex v e2) in *. set (fa := L v d1 e1) in *. set (fb := L v d1 e2) in *.
  set (ra := cv v dl e1 - a - fa) in *. set (rb := cv v dl e2 - b - fb) in *.
  split.
  + apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult, Rplus_comm.
    apply Rplus_le_compat; apply Rmult_le_compat; auto using Rabs_pos.
  + replace (cv v dl e1 * cv v dl e2 - a * b - (fa * b + a * fb))
    with (fa * fb + ra * (b + fb + rb) + (a + fa) * rb) by (unfold ra, rb; ring).
    apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat.
    apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat.
    * rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
    * rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
      apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat; [| exact B2].
      apply Rle_trans with (1 := Rabs_triang _ _). lra.
    * rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
      apply Rle_trans with (1 := Rabs_triang _ _). lra.
- destruct IHe as [A B]; try assumption. split.
  + rewrite Rabs_Ropp. exact A.
  + replace (- cv v dl e - - ex v e - - L v d1 e) with (- (cv v dl e - ex v e - L v d1 e)) by ring.
    rewrite Rabs_Ropp. exact B.
- destruct W as (K & EB & W), E as [E D]. destruct IHe as [A B]; try assumption.
  assert (Z : Rabs (d1 k) <= (if rel k then u * s k else h k) /\
    Rabs (dl k - d1 k) <= (if rel k then u * (FO e + HO e) + tau else 0)).
  { unfold d1, w. destruct (rel k).
    - pose proof (sizes k) as SK. rewrite <- EB in *.
      assert (C : Rabs (cv v dl e) <= Rabs (ex v e) + (FO e + HO e)).
      { replace (cv v dl e) with (ex v e + (L v d1 e + (cv v dl e - ex v e - L v d1 e))) by ring.
        apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat_l.
        apply Rle_trans with (1 := Rabs_triang _ _). lra. }
      destruct (clamp (u * Rabs (ex v e)) (dl k) (u * (FO e + HO e) + tau)) as [C1 C2].
      + apply Rmult_le_pos; auto using Rabs_pos.
      + assert (0 <= FO e + HO e) by (pose proof (Rabs_pos (L v d1 e)); pose proof (Rabs_pos (cv v dl e - ex v e - L v d1 e)); lra). nra.
      + nra.
      + split; [| exact C2]. apply Rle_trans with (1 := C1). apply Rmult_le_compat_l; assumption.
    - rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra. }
  destruct Z as [Z1 Z2]. split.
  + apply Rle_trans with (1 := Rabs_triang _ _). lra.
  + replace (cv v dl e + dl k - ex v e - (L v d1 e + d1 k)) with ((cv v dl e - ex v e - L v d1 e) + (dl k - d1 k)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

(** The first order is at most the sum of the effects at v. *)
Definition wt (k : nat) := if rel k then u else h k.
Definition effects (x : env) (e : expr) := sum n (fun k => Rabs (G (rel k) k x e) * wt k).

Lemma errors_bound e k : shared n body e -> errors e ->
  Rabs (G false k v e) * Rabs (d1 k) <= Rabs (G (rel k) k v e) * wt k \/ G false k v e = 0.
Proof.
intros W E.
(* either k is not a step of e, or its error is known *)
assert (D : G false k v e = 0 \/ (rel k = false -> Rabs (dl k) <= h k)).
{ clear - E. induction e; simpl in *; auto.
  - destruct E as [E1 E2]. destruct (IHe1 E1) as [Z1 | ?]; auto. destruct (IHe2 E2) as [Z2 | ?]; auto.
    left. rewrite Z1, Z2. ring.
  - destruct E as [E1 E2]. destruct (IHe1 E1) as [Z1 | ?]; auto. destruct (IHe2 E2) as [Z2 | ?]; auto.
    left. rewrite Z1, Z2. ring.
  - destruct E as [E1 E2]. destruct (IHe1 E1) as [Z1 | ?]; auto. destruct (IHe2 E2) as [Z2 | ?]; auto.
    left. rewrite Z1, Z2. ring.
  - destruct (IHe E) as [Z | ?]; auto. left. rewrite Z. ring.
  - destruct E as [E D]. destruct (Nat.eqb_spec k0 k).
    + subst. right. intros R. rewrite R in D. exact D.
    + destruct (IHe E) as [Z | ?]; auto. left. rewrite Z. ring. }
destruct D as [D | D]; [right; exact D | left].
unfold wt, d1, w. destruct (rel k) eqn:R.
- rewrite (G_relative n body) by assumption. rewrite Rabs_mult, Rmult_assoc.
  apply Rmult_le_compat_l; [apply Rabs_pos |]. rewrite (Rmult_comm _ u).
  set (a := u * Rabs (ex v (body k))). assert (0 <= a) by (apply Rmult_le_pos; auto using Rabs_pos).
  unfold Rmax, Rmin, Rabs. repeat (destruct Rle_dec || destruct Rcase_abs); lra.
- apply Rmult_le_compat_l; [apply Rabs_pos |]. auto.
Qed.

Hypothesis h0 : forall k, 0 <= h k.
Theorem first_order e : shared n body e -> errors e -> Rabs (L v d1 e) <= effects v e.
Proof.
intros W E. rewrite (L_sum n body) by assumption. apply Rle_trans with (1 := sum_abs _ _).
apply sum_le. intros k _. rewrite Rabs_mult.
destruct (errors_bound e k W E) as [B | ->]; [exact B |].
rewrite Rabs_R0, Rmult_0_l. apply Rmult_le_pos; [apply Rabs_pos |].
unfold wt. destruct (rel k); auto.
Qed.

Theorem error_at e : shared n body e -> errors e -> Rabs (cv v dl e - ex v e) <= effects v e + HO e.
Proof.
intros W E. destruct (orders e W E) as [_ B]. pose proof (first_order e W E) as A.
replace (cv v dl e - ex v e) with (L v d1 e + (cv v dl e - ex v e - L v d1 e)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.
End Orders.

(** ** Corners *)
Definition indep (i : nat) (f : env -> R) := forall v x, f (upd v i x) = f v.
Definition affine (i : nat) (f : env -> R) := forall v x y l,
  f (upd v i ((1 - l) * x + l * y)) = (1 - l) * f (upd v i x) + l * f (upd v i y).

Lemma indep_affine i f : indep i f -> affine i f.
Proof. intros I v x y l. rewrite !I. ring. Qed.
Lemma affine_mul i f g : affine i f -> indep i g -> affine i (fun v => f v * g v).
Proof. intros A I v x y l. rewrite A, !I. ring. Qed.
Lemma affine_mul' i f g : indep i f -> affine i g -> affine i (fun v => f v * g v).
Proof. intros I A v x y l. rewrite A, !I. ring. Qed.

Lemma ex_indep i e : ~ dep i e -> indep i (fun v => ex v e).
Proof.
induction e; simpl; intros D v x; try (rewrite ?IHe, ?IHe1, ?IHe2 by tauto; reflexivity).
unfold upd. destruct (Nat.eqb_spec i0 i); [subst; tauto | reflexivity].
Qed.
Lemma G_indep rel k i e : ~ dep i e -> indep i (fun v => G rel k v e).
Proof.
induction e; simpl; intros D v x.
- reflexivity.
- reflexivity.
- rewrite IHe1, IHe2 by tauto. reflexivity.
- rewrite IHe1, IHe2 by tauto. reflexivity.
- rewrite IHe1, IHe2, (ex_indep i e1), (ex_indep i e2) by tauto. reflexivity.
- rewrite IHe by tauto. reflexivity.
- rewrite IHe, (ex_indep i e) by tauto. reflexivity.
Qed.

Lemma dep_dec i e : dep i e \/ ~ dep i e.
Proof.
induction e; simpl; try (destruct (Nat.eq_dec i i0); tauto); tauto.
Qed.

Lemma ex_affine i e : apart e -> affine i (fun v => ex v e).
Proof.
induction e; simpl; intros A.
- intros v x y l. unfold upd. cbv beta. destruct (Nat.eqb i0 i).
  + ring.
  + ring.
- intros v x y l; ring.
- destruct A. intros v x y l. rewrite IHe1, IHe2 by assumption. ring.
- destruct A. intros v x y l. rewrite IHe1, IHe2 by assumption. ring.
- destruct A as (A & B & D). destruct (dep_dec i e1) as [D1 | D1].
  + assert (D2 : ~ dep i e2) by (intros D2; eapply D; eauto).
    exact (affine_mul i _ _ (IHe1 A) (ex_indep i e2 D2)).
  + exact (affine_mul' i _ _ (ex_indep i e1 D1) (IHe2 B)).
- intros v x y l. rewrite IHe by assumption. ring.
- auto.
Qed.

Lemma G_affine rel k i e : apart e -> affine i (fun v => G rel k v e).
Proof.
induction e; simpl; intros A.
- intros v x y l; ring.
- intros v x y l; ring.
- destruct A. intros v x y l. rewrite IHe1, IHe2 by assumption. ring.
- destruct A. intros v x y l. rewrite IHe1, IHe2 by assumption. ring.
- destruct A as (A & B & D). intros v x y l. destruct (dep_dec i e1) as [D1 | D1].
  + assert (D2 : ~ dep i e2) by (intros D2; eapply D; eauto).
    rewrite (affine_mul i _ _ (IHe1 A) (ex_indep i e2 D2) v x y l).
    rewrite (affine_mul i _ _ (ex_affine i e1 A) (G_indep rel k i e2 D2) v x y l). ring.
  + rewrite (affine_mul' i _ _ (G_indep rel k i e1 D1) (ex_affine i e2 B) v x y l).
    rewrite (affine_mul' i _ _ (ex_indep i e1 D1) (IHe2 B) v x y l). ring.
- intros v x y l. rewrite IHe by assumption. ring.
- intros v x y l. rewrite IHe by assumption.
  destruct (Nat.eqb k0 k), rel; try ring. rewrite (ex_affine i e A v x y l). ring.
Qed.

Definition convex (i : nat) (f : env -> R) := forall v x y l, 0 <= l <= 1 ->
  f (upd v i ((1 - l) * x + l * y)) <= (1 - l) * f (upd v i x) + l * f (upd v i y).

Lemma affine_convex i f : affine i f -> convex i (fun v => Rabs (f v)).
Proof.
intros A v x y l Hl. rewrite A. apply Rle_trans with (1 := Rabs_triang _ _).
rewrite !Rabs_mult, (Rabs_pos_eq l), (Rabs_pos_eq (1 - l)) by lra. lra.
Qed.

Lemma effects_convex n u h rel e i : 0 <= u -> (forall k, 0 <= h k) -> apart e ->
  convex i (fun v => effects n u h rel v e).
Proof.
intros U0 H0 A v x y l Hl. unfold effects.
rewrite <- !sum_scal, <- sum_plus. apply sum_le. intros k _.
pose proof (affine_convex i _ (G_affine (rel k) k i e A) v x y l Hl) as C.
assert (0 <= wt u h rel k) by (unfold wt; destruct (rel k); auto). nra.
Qed.

Section Corners.
Variables (lo hi : nat -> R).
Definition corner (n : nat) (v c : env) := forall i, ((i < n)%nat -> c i = lo i \/ c i = hi i) /\ ((n <= i)%nat -> c i = v i).

Lemma convex_end i f v : convex i f -> lo i <= v i <= hi i ->
  exists x, (x = lo i \/ x = hi i) /\ f v <= f (upd v i x).
Proof.
intros C [A B].
assert (I : upd v i (v i) = v).
{ apply functional_extensionality; intros j. unfold upd. destruct (Nat.eqb_spec j i); [subst |]; reflexivity. }
destruct (Rle_lt_or_eq_dec _ _ (Rle_trans _ _ _ A B)) as [LT | E].
2: { exists (lo i). split; [auto |]. replace (lo i) with (v i) by lra. rewrite I. lra. }
set (l := (v i - lo i) / (hi i - lo i)).
assert (E : v i = (1 - l) * lo i + l * hi i) by (unfold l; field; lra).
assert (Hl : 0 <= l <= 1).
{ unfold l. split.
  - apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra].
  - apply Rmult_le_reg_r with (hi i - lo i); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
pose proof (C v (lo i) (hi i) l Hl) as K. rewrite <- E, I in K.
destruct (Rle_dec (f v) (f (upd v i (lo i)))) as [F | F].
- exists (lo i); auto.
- exists (hi i). split; [auto |]. apply Rnot_lt_le. intros F2. apply Rnot_le_lt in F.
  set (a := f (upd v i (lo i))) in *. set (b := f (upd v i (hi i))) in *. set (y := f v) in *.
  assert (P1 : 0 <= (1 - l) * (y - a)) by (apply Rmult_le_pos; lra).
  assert (P2 : 0 <= l * (y - b)) by (apply Rmult_le_pos; lra).
  destruct (Rle_dec l (/ 2)).
  + assert (0 < (1 - l) * (y - a)) by (apply Rmult_lt_0_compat; lra). lra.
  + assert (0 < l * (y - b)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Theorem corners n f v : (forall i, convex i f) -> (forall i, (i < n)%nat -> lo i <= v i <= hi i) ->
  exists c, corner n v c /\ f v <= f c.
Proof.
intros C. induction n; intros B.
{ exists v. split; [| lra]. split; [lia | auto]. }
destruct IHn as (c & K & F); [intros; apply B; lia |].
assert (N : lo n <= c n <= hi n).
{ rewrite (proj2 (K n)) by lia. apply B; lia. }
destruct (convex_end n f c (C n) N) as (x & X & FX).
exists (upd c n x). split; [| lra]. intros i. unfold upd. destruct (Nat.eqb_spec i n) as [-> | Ne]; split; intros I.
- exact X.
- lia.
- apply K; lia.
- apply K; lia.
Qed.
End Corners.

(** ** The rule: |computed - exact| <= first + rest. *)
Section Rule.
Variables (n vars : nat) (body : nat -> expr) (u tau : R).
Hypothesis u0 : 0 <= u.
Hypothesis tau0 : 0 <= tau.
Variables (lo hi m s h : nat -> R) (rel : nat -> bool) (e : expr).
Hypothesis h0 : forall k, 0 <= h k.
Hypothesis ends : forall i, Rabs (lo i) <= m i /\ Rabs (hi i) <= m i.
Hypothesis is_apart : apart e.
Hypothesis is_shared : shared n body e.
Hypothesis bodies_apart : forall k, apart (body k).

(** What the checker computes: the largest sum of effects, and sizes, at all corners of the first [vars] variables
    (all others are 0). *)
Definition is_corner (c : env) := corner lo hi vars (fun _ => 0) c.
Variable first : R.
Hypothesis first_is_max : forall c, is_corner c -> effects n u h rel c e <= first.
Hypothesis s_is_max : forall k c, is_corner c -> Rabs (ex c (body k)) <= s k.

Variables (v dl : env).
Hypothesis in_box : forall i, (i < vars)%nat -> lo i <= v i <= hi i.
Hypothesis others : forall i, (vars <= i)%nat -> v i = 0.

Lemma corner_of c : corner lo hi vars v c -> is_corner c.
Proof. intros K i. split; intros I; [apply K; exact I |]. rewrite (proj2 (K i)) by exact I. apply others, I. Qed.

Theorem sum_of_products : errors u tau h rel v dl e ->
  Rabs (cv v dl e - ex v e) <= first + HO u tau m s h rel e.
Proof.
intros E.
assert (M0 : forall i, 0 <= m i) by (intros i; pose proof (Rabs_pos (lo i)); pose proof (ends i); lra).
apply Rle_trans with (effects n u h rel v e + HO u tau m s h rel e).
- apply (error_at n body); try assumption.
  + intros i. destruct (Nat.lt_ge_cases i vars) as [I | I].
    * pose proof (in_box i I). pose proof (ends i). unfold Rabs in *. repeat destruct Rcase_abs; lra.
    * rewrite others by exact I. rewrite Rabs_R0. apply M0.
  + intros k. destruct (corners lo hi vars (fun v => Rabs (ex v (body k))) v) as (c & K & F).
    * intros i. apply affine_convex, ex_affine, bodies_apart.
    * exact in_box.
    * apply Rle_trans with (1 := F). apply s_is_max, corner_of, K.
- apply Rplus_le_compat_r.
  destruct (corners lo hi vars (fun v => effects n u h rel v e) v) as (c & K & F).
  + intros i. apply effects_convex; assumption.
  + exact in_box.
  + apply Rle_trans with (1 := F). apply first_is_max, corner_of, K.
Qed.
End Rule.
