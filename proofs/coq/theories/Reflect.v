(** A checker of the sum rule that Coq runs itself: dyadic numbers, every corner, and a proof that its answer is right. *)
From Coq Require Import ZArith Reals Lia Lra List FunctionalExtensionality Arith Bool.
From Flocq Require Import Core Operations.
From Hairline Require Import Rounding Sum.
Import ListNotations.
Open Scope R_scope.

Definition D := float radix2.
Notation "[[ x ]]" := (@F2R radix2 x).
Definition dy (m e : Z) : D := Float radix2 m e.
Definition zero : D := dy 0 0.
Definition leb (a b : D) : bool := Z.leb (Fnum (Fminus a b)) 0.
Lemma leb_ok a b : leb a b = true -> [[a]] <= [[b]].
Proof.
unfold leb. intros E. apply Z.leb_le in E.
assert ([[Fminus a b]] <= 0). { apply F2R_le_0. exact E. }
rewrite F2R_minus in H. lra.
Qed.
Lemma zero_ok : [[zero]] = 0. Proof. apply F2R_0. Qed.

Inductive xp := XVar (i : nat) | XNum (z : Z) | XAdd (a b : xp) | XSub (a b : xp) | XMul (a b : xp) | XNeg (a : xp)
  | XStep (k : nat) (a : xp).
Fixpoint tr (x : xp) : expr := match x with
  | XVar i => Var i | XNum z => Num (IZR z) | XAdd a b => Add (tr a) (tr b) | XSub a b => Sub (tr a) (tr b)
  | XMul a b => Mul (tr a) (tr b) | XNeg a => Neg (tr a) | XStep k a => Step k (tr a) end.
Fixpoint xeqb (x y : xp) : bool := match x, y with
  | XVar i, XVar j => Nat.eqb i j | XNum a, XNum b => Z.eqb a b
  | XAdd a b, XAdd c d | XSub a b, XSub c d | XMul a b, XMul c d => xeqb a c && xeqb b d
  | XNeg a, XNeg b => xeqb a b | XStep k a, XStep j b => Nat.eqb k j && xeqb a b | _, _ => false end.
Lemma xeqb_ok x : forall y, xeqb x y = true -> x = y.
Proof.
induction x; intros y E; destruct y; simpl in E; try discriminate;
  repeat match goal with H : _ && _ = true |- _ => apply andb_prop in H; destruct H end;
  try match goal with H : Nat.eqb _ _ = true |- _ => apply Nat.eqb_eq in H; subst end;
  try match goal with H : Z.eqb _ _ = true |- _ => apply Z.eqb_eq in H; subst end; f_equal; auto.
Qed.

Definition at_ (l : list D) (i : nat) : D := nth i l zero.
Definition real (l : list D) : env := fun i => [[at_ l i]].

Fixpoint exD (l : list D) (x : xp) : D := match x with
  | XVar i => at_ l i | XNum z => dy z 0
  | XAdd a b => Fplus (exD l a) (exD l b) | XSub a b => Fminus (exD l a) (exD l b)
  | XMul a b => Fmult (exD l a) (exD l b) | XNeg a => Fopp (exD l a) | XStep _ a => exD l a end.
Lemma exD_ok l x : [[exD l x]] = ex (real l) (tr x).
Proof.
induction x; simpl; rewrite ?F2R_plus, ?F2R_minus, ?F2R_mult, ?F2R_opp, ?IHx, ?IHx1, ?IHx2; try reflexivity.
unfold dy, F2R; simpl. ring.
Qed.

Fixpoint GD (k : nat) (l : list D) (x : xp) : D := match x with
  | XVar _ | XNum _ => zero
  | XAdd a b => Fplus (GD k l a) (GD k l b) | XSub a b => Fminus (GD k l a) (GD k l b) | XNeg a => Fopp (GD k l a)
  | XMul a b => Fplus (Fmult (GD k l a) (exD l b)) (Fmult (exD l a) (GD k l b))
  | XStep j a => Fplus (if Nat.eqb j k then dy 1 0 else zero) (GD k l a) end.
Lemma GD_ok k l x : [[GD k l x]] = G false k (real l) (tr x).
Proof.
induction x; simpl; rewrite ?F2R_plus, ?F2R_minus, ?F2R_mult, ?F2R_opp, ?exD_ok, ?IHx, ?IHx1, ?IHx2, ?zero_ok; try reflexivity.
destruct (Nat.eqb k0 k); rewrite ?zero_ok; unfold dy, F2R; simpl; ring.
Qed.

(** What a certificate of the sum rule says. *)
Record cert := { p : Z; smin : Z; ends : list (D * D); sizes_of_vars : list D; steps : list xp;
  sizes : list D; exps : list Z; first : D; rest : D; error : D }.

Section Check.
Variable c : cert.
Definition n := length (steps c).
Definition vars := length (ends c).
Definition bodyX k := nth k (steps c) (XNum 0).
Definition top := XStep (n - 1) (bodyX (n - 1)).
Definition hD k := dy 1 (Z.max (nth k (exps c) 0%Z - p c) (smin c) - 1).

Fixpoint effD (k : nat) (l : list D) : D := match k with
  | O => zero | S j => Fplus (effD j l) (Fmult (Fabs (GD j l top)) (hD j)) end.

Definition none : nat -> bool := fun _ => false.
Definition h (k : nat) : R := [[hD k]].
Definition s (k : nat) : R := [[at_ (sizes c) k]].
Definition m (i : nat) : R := [[at_ (sizes_of_vars c) i]].
Definition body (k : nat) := tr (bodyX k).

Lemma effD_ok k l u : [[effD k l]] = Sum.sum k (fun j => Rabs (G (none j) j (real l) (tr top)) * wt u h none j).
Proof.
induction k; cbn [effD Sum.sum]; [apply zero_ok |]. rewrite F2R_plus, F2R_mult, F2R_abs, GD_ok, IHk. reflexivity.
Qed.

Fixpoint szD (x : xp) : D := match x with
  | XVar i => at_ (sizes_of_vars c) i | XNum z => dy (Z.abs z) 0
  | XAdd a b | XSub a b => Fplus (szD a) (szD b) | XMul a b => Fmult (szD a) (szD b) | XNeg a => szD a
  | XStep k _ => at_ (sizes c) k end.
Fixpoint FOD (x : xp) : D := match x with
  | XVar _ | XNum _ => zero
  | XAdd a b | XSub a b => Fplus (FOD a) (FOD b) | XNeg a => FOD a
  | XMul a b => Fplus (Fmult (szD a) (FOD b)) (Fmult (FOD a) (szD b))
  | XStep k a => Fplus (FOD a) (hD k) end.
Fixpoint HOD (x : xp) : D := match x with
  | XVar _ | XNum _ => zero
  | XAdd a b | XSub a b => Fplus (HOD a) (HOD b) | XNeg a => HOD a
  | XMul a b => Fplus (Fplus (Fmult (FOD a) (FOD b)) (Fmult (HOD a) (Fplus (Fplus (szD b) (FOD b)) (HOD b))))
                      (Fmult (Fplus (szD a) (FOD a)) (HOD b))
  | XStep k a => HOD a end.
Lemma szD_ok x : [[szD x]] = sz m s (tr x).
Proof.
induction x; simpl; rewrite ?F2R_plus, ?F2R_mult, ?IHx, ?IHx1, ?IHx2; try reflexivity.
unfold dy, F2R; simpl. rewrite abs_IZR. ring.
Qed.
Lemma FOD_ok x u : [[FOD x]] = FO u m s h none (tr x).
Proof. induction x; simpl; rewrite ?F2R_plus, ?F2R_mult, ?szD_ok, ?zero_ok, ?IHx, ?IHx1, ?IHx2; reflexivity. Qed.
Lemma HOD_ok x u t : [[HOD x]] = HO u t m s h none (tr x).
Proof.
induction x; simpl; rewrite ?F2R_plus, ?F2R_mult, ?F2R_plus, ?szD_ok, ?(FOD_ok _ u), ?zero_ok, ?IHx, ?IHx1, ?IHx2; try reflexivity.
unfold none. ring.
Qed.

Fixpoint envs (l : list (D * D)) : list (list D) := match l with
  | nil => nil :: nil | (a, b) :: r => flat_map (fun t => [a :: t; b :: t]) (envs r) end.

Fixpoint depb (i : nat) (x : xp) : bool := match x with
  | XVar j => Nat.eqb i j | XNum _ => false | XAdd a b | XSub a b | XMul a b => depb i a || depb i b
  | XNeg a | XStep _ a => depb i a end.
Fixpoint below (x : xp) : bool := match x with
  | XVar j => Nat.ltb j vars | XNum _ => true | XAdd a b | XSub a b | XMul a b => below a && below b
  | XNeg a | XStep _ a => below a end.
Fixpoint apartb (x : xp) : bool := match x with
  | XVar _ | XNum _ => true | XAdd a b | XSub a b => apartb a && apartb b
  | XMul a b => apartb a && apartb b && forallb (fun i => negb (depb i a && depb i b)) (seq 0 vars)
  | XNeg a | XStep _ a => apartb a end.
Fixpoint sharedb (x : xp) : bool := match x with
  | XVar _ | XNum _ => true | XAdd a b | XSub a b | XMul a b => sharedb a && sharedb b
  | XNeg a => sharedb a
  | XStep k a => Nat.ltb k n && xeqb a (bodyX k) && sharedb a
     && leb (Fplus (at_ (sizes c) k) (Fplus (FOD a) (HOD a))) (dy 1 (nth k (exps c) 0%Z)) end.

Definition check : bool :=
  Z.leb 1 (p c) && sharedb top
  && forallb (fun k => apartb (bodyX k) && below (bodyX k)) (seq 0 n) && Nat.ltb 0 n
  && forallb (fun i => leb (Fabs (fst (nth i (ends c) (zero, zero)))) (at_ (sizes_of_vars c) i)
                    && leb (Fabs (snd (nth i (ends c) (zero, zero)))) (at_ (sizes_of_vars c) i)) (seq 0 vars)
  && (Nat.eqb (length (sizes_of_vars c)) vars && Nat.eqb (length (sizes c)) n)
  && forallb (fun l => leb (effD n l) (first c)
       && forallb (fun k => leb (Fabs (exD l (bodyX k))) (at_ (sizes c) k)) (seq 0 n)) (envs (ends c))
  && leb (HOD top) (rest c) && leb (Fplus (first c) (rest c)) (error c).
End Check.

(** ** It is right. *)
Lemma depb_ok i x : dep i (tr x) -> depb i x = true.
Proof. induction x; simpl; intros; subst; rewrite ?Nat.eqb_refl; auto; try tauto; apply orb_true_iff; tauto. Qed.
Lemma below_ok c i x : below c x = true -> dep i (tr x) -> (i < vars c)%nat.
Proof.
induction x; simpl; intros B Dp; subst; auto; try (apply andb_prop in B; destruct B; destruct Dp; auto).
- apply Nat.ltb_lt. exact B.
- contradiction.
Qed.
Lemma apartb_ok c x : below c x = true -> apartb c x = true -> apart (tr x).
Proof.
induction x; simpl; intros B A; auto;
  try (apply andb_prop in B; destruct B as [B1 B2]).
- apply andb_prop in A; destruct A. auto.
- apply andb_prop in A; destruct A. auto.
- apply andb_prop in A; destruct A as [A F]. apply andb_prop in A; destruct A. repeat split; auto.
  intros i D1 D2. rewrite forallb_forall in F. specialize (F i).
  rewrite (depb_ok _ _ D1), (depb_ok _ _ D2) in F. simpl in F.
  assert (false = true); [apply F | discriminate]. apply in_seq. pose proof (below_ok _ _ _ B1 D1). lia.
Qed.

Lemma envs_ok l : forall v : env,
  (forall i, (i < length l)%nat -> v i = [[fst (nth i l (zero, zero))]] \/ v i = [[snd (nth i l (zero, zero))]]) ->
  (forall i, (length l <= i)%nat -> v i = 0) ->
  exists t, In t (envs l) /\ v = real t.
Proof.
induction l as [| [a b] r IH]; intros v E Z.
- exists []. split; [left; reflexivity |]. apply functional_extensionality; intros i. rewrite Z by (simpl; lia).
  unfold real, at_. destruct i; simpl; symmetry; apply zero_ok.
- destruct (IH (fun i => v (S i))) as (t & T & V).
  + intros i I. apply (E (S i)). simpl; lia.
  + intros i I. apply Z. simpl; lia.
  + assert (R : forall x, v 0%nat = [[x]] -> v = real (x :: t)).
    { intros x X. apply functional_extensionality; intros [| i]; [exact X |]. exact (f_equal (fun f => f i) V). }
    destruct (E 0%nat) as [X | X]; [simpl; lia | |]; simpl in X; specialize (R _ X);
      [exists (a :: t) | exists (b :: t)]; (split; [| exact R]); simpl; apply in_flat_map; exists t; simpl; auto.
Qed.

Fixpoint rounds (fl : R -> R) (v dl : env) (x : expr) : Prop := match x with
  | Var _ | Num _ => True
  | Add a b | Sub a b | Mul a b => rounds fl v dl a /\ rounds fl v dl b | Neg a => rounds fl v dl a
  | Step k a => rounds fl v dl a /\ dl k = fl (cv v dl a) - cv v dl a end.

Section Sound.
Variables (c : cert) (choice : Z -> bool).
Notation fl := (fl (p c) (smin c) choice).
Hypothesis Hp : (1 <= p c)%Z.
Variables (v dl : env).
Hypothesis box : forall i, Rabs (v i) <= m c i.
Hypothesis sizes_ok : forall k, Rabs (ex v (body c k)) <= s c k.

Lemma shared_ok x : sharedb c x = true -> shared (n c) (body c) (tr x).
Proof.
induction x; simpl; intros A; auto; try (apply andb_prop in A; destruct A; auto; fail).
apply andb_prop in A; destruct A as [A _]. apply andb_prop in A; destruct A as [A A2]. apply andb_prop in A; destruct A as [A A1].
repeat split; auto. { apply Nat.ltb_lt, A. } apply xeqb_ok in A1. subst. reflexivity.
Qed.

Lemma errors_ok x : sharedb c x = true -> rounds fl v dl (tr x) -> errors 0 0 (h c) none v dl (tr x).
Proof.
induction x; simpl; intros A Rn; auto; try (apply andb_prop in A; destruct A, Rn; split; auto; fail).
pose proof (shared_ok (XStep k x) A) as (_ & EB & Sh).
apply andb_prop in A; destruct A as [A Lk]. apply andb_prop in A; destruct A as [A A2]. apply andb_prop in A; destruct A as [A A1].
destruct Rn as [Rn E]. assert (Er := IHx A2 Rn). split; [exact Er |].
apply leb_ok in Lk. rewrite !F2R_plus, (FOD_ok c x 0), (HOD_ok c x 0 0) in Lk. fold (s c k) in Lk.
destruct (orders (n c) (body c) 0 0 (Rle_refl 0) (Rle_refl 0) (m c) (s c) (h c) none v dl box sizes_ok (tr x) Sh Er) as [O1 O2].
assert (Z : Rabs (cv v dl (tr x)) <= bpow radix2 (nth k (exps c) 0%Z)).
{ pose proof (sizes_ok k) as SK. rewrite <- EB in SK.
  replace (cv v dl (tr x)) with (ex v (tr x) + (L v (d1 (body c) 0 (h c) none v dl) (tr x) +
    (cv v dl (tr x) - ex v (tr x) - L v (d1 (body c) 0 (h c) none v dl) (tr x)))) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _).
  apply Rle_trans with (1 := Rplus_le_compat_l _ _ _ (Rabs_triang _ _)).
  unfold dy in Lk. rewrite F2R_bpow in Lk. lra. }
rewrite E. apply Rle_trans with (1 := fl_half_ulp (p c) (smin c) Hp choice _ _ Z).
unfold h, hD, dy. rewrite F2R_bpow. apply Rle_refl.
Qed.
End Sound.

Theorem check_sound (c : cert) choice : check c = true -> forall v dl : env,
  (forall i, (i < vars c)%nat -> [[fst (nth i (ends c) (zero, zero))]] <= v i <= [[snd (nth i (ends c) (zero, zero))]]) ->
  (forall i, (vars c <= i)%nat -> v i = 0) ->
  rounds (fl (p c) (smin c) choice) v dl (tr (top c)) ->
  Rabs (cv v dl (tr (top c)) - ex v (tr (top c))) <= [[error c]].
Proof.
unfold check. intros K v dl Box Out Rn.
apply andb_prop in K; destruct K as [K Ke]. apply andb_prop in K; destruct K as [K Kr]. apply andb_prop in K; destruct K as [K Kc]. apply andb_prop in K; destruct K as [K Klen]. apply andb_prop in K; destruct K as [K Kends]. apply andb_prop in K; destruct K as [K Kn]. apply andb_prop in K; destruct K as [K Kap]. apply andb_prop in K; destruct K as [K Ksh]. rename K into Kp.
apply Z.leb_le in Kp. apply Nat.ltb_lt in Kn. apply andb_prop in Klen. destruct Klen as [Klen Ksz]. apply Nat.eqb_eq in Klen, Ksz. apply leb_ok in Kr, Ke.
rewrite F2R_plus in Ke. rewrite forallb_forall in Kap, Kends, Kc.
assert (Bodies : forall k, apart (body c k)).
{ intros k. destruct (Nat.lt_ge_cases k (n c)) as [I | I].
  - specialize (Kap k ltac:(apply in_seq; lia)). apply andb_prop in Kap. apply (apartb_ok c); apply Kap.
  - unfold body, bodyX. rewrite nth_overflow by exact I. exact Logic.I. }
set (lo := fun i => [[fst (nth i (ends c) (zero, zero))]]). set (hi := fun i => [[snd (nth i (ends c) (zero, zero))]]).
assert (Ends : forall i, Rabs (lo i) <= m c i /\ Rabs (hi i) <= m c i).
{ intros i. destruct (Nat.lt_ge_cases i (vars c)) as [I | I].
  - specialize (Kends i ltac:(apply in_seq; lia)). apply andb_prop in Kends. destruct Kends as [E1 E2].
    apply leb_ok in E1, E2. rewrite F2R_abs in E1, E2. auto.
  - unfold lo, hi, m, at_. rewrite !(nth_overflow (ends c)) by exact I. rewrite (nth_overflow (sizes_of_vars c)) by lia.
    simpl fst; simpl snd. rewrite zero_ok, Rabs_R0. lra. }
assert (Corner : forall x, is_corner (vars c) lo hi x -> exists l, In l (envs (ends c)) /\ x = real l).
{ intros x X. apply envs_ok; intros i I; apply X; exact I. }
assert (Sizes : forall k x, is_corner (vars c) lo hi x -> Rabs (ex x (body c k)) <= s c k).
{ intros k x X. destruct (Corner x X) as (l & Il & ->). destruct (Nat.lt_ge_cases k (n c)) as [I | I].
  - specialize (Kc l Il). apply andb_prop in Kc. destruct Kc as [_ Kc]. rewrite forallb_forall in Kc.
    specialize (Kc k ltac:(apply in_seq; lia)). apply leb_ok in Kc. rewrite F2R_abs, exD_ok in Kc. exact Kc.
  - unfold body, bodyX. rewrite nth_overflow by exact I. simpl. rewrite Rabs_R0.
    unfold s, at_. rewrite nth_overflow by lia. rewrite zero_ok. lra. }
assert (In_box : forall i, Rabs (v i) <= m c i).
{ intros i. destruct (Nat.lt_ge_cases i (vars c)) as [I | I].
  - pose proof (Box i I). pose proof (Ends i) as [E1 E2]. unfold lo, hi in *. unfold Rabs in *. repeat destruct Rcase_abs; lra.
  - rewrite Out, Rabs_R0 by exact I. pose proof (Ends i) as [E1 _]. pose proof (Rabs_pos (lo i)). lra. }
assert (Sizes_v : forall k, Rabs (ex v (body c k)) <= s c k).
{ intros k. destruct (corners lo hi (vars c) (fun x => Rabs (ex x (body c k))) v) as (x & X & F).
  - intros i. apply affine_convex, ex_affine, Bodies.
  - exact Box.
  - apply Rle_trans with (1 := F). apply Sizes. apply (corner_of (vars c) lo hi v Out). exact X. }
assert (Top : apart (tr (top c))) by (apply (Bodies (n c - 1)%nat)).
assert (Hh : forall k, 0 <= h c k) by (intros k; unfold h, hD, dy; rewrite F2R_bpow; apply bpow_ge_0).
apply Rle_trans with (2 := Ke). apply Rle_trans with ([[first c]] + HO 0 0 (m c) (s c) (h c) none (tr (top c))).
2: { rewrite <- (HOD_ok c (top c) 0 0). lra. }
apply (sum_of_products (n c) (vars c) (body c) 0 0 (Rle_refl 0) (Rle_refl 0) lo hi (m c) (s c) (h c) none); try assumption.
- apply (shared_ok c), Ksh.
- intros x X. destruct (Corner x X) as (l & Il & ->). specialize (Kc l Il). apply andb_prop in Kc. destruct Kc as [Kc _].
  apply leb_ok in Kc. rewrite (effD_ok c (n c) l 0) in Kc. exact Kc.
- apply (errors_ok c choice); assumption.
Qed.

(** The program itself, in floats: every step is rounded. *)
Fixpoint fv (fl : R -> R) (v : env) (e : expr) : R := match e with
  | Var i => v i | Num c => c
  | Add a b => fv fl v a + fv fl v b | Sub a b => fv fl v a - fv fl v b | Mul a b => fv fl v a * fv fl v b
  | Neg a => - fv fl v a | Step _ a => fl (fv fl v a) end.

Lemma fv_rounds fl n body v e : shared n body e ->
  let dl k := fl (fv fl v (body k)) - fv fl v (body k) in
  cv v dl e = fv fl v e /\ rounds fl v dl e.
Proof.
intros W dl. induction e; simpl in *; auto.
- destruct W as [W1 W2]. destruct (IHe1 W1) as [-> ?], (IHe2 W2) as [-> ?]. auto.
- destruct W as [W1 W2]. destruct (IHe1 W1) as [-> ?], (IHe2 W2) as [-> ?]. auto.
- destruct W as [W1 W2]. destruct (IHe1 W1) as [-> ?], (IHe2 W2) as [-> ?]. auto.
- destruct (IHe W) as [-> ?]. auto.
- destruct W as (_ & E & W). destruct (IHe W) as [Ec Rn]. rewrite Ec.
  assert (Q : dl k = fl (fv fl v e) - fv fl v e) by (unfold dl; rewrite <- E; reflexivity).
  rewrite Q. repeat split; auto. ring.
Qed.

Theorem check_program (c : cert) choice : check c = true -> forall v : env,
  (forall i, (i < vars c)%nat -> [[fst (nth i (ends c) (zero, zero))]] <= v i <= [[snd (nth i (ends c) (zero, zero))]]) ->
  (forall i, (vars c <= i)%nat -> v i = 0) ->
  Rabs (fv (fl (p c) (smin c) choice) v (tr (top c)) - ex v (tr (top c))) <= [[error c]].
Proof.
intros K v Box Out.
assert (Sh : shared (n c) (body c) (tr (top c))).
{ apply shared_ok. unfold check in K. repeat (apply andb_prop in K; destruct K as [K ?]). assumption. }
destruct (fv_rounds (fl (p c) (smin c) choice) _ _ v _ Sh) as [E Rn].
rewrite <- E. apply (check_sound c choice K v _ Box Out Rn).
Qed.
