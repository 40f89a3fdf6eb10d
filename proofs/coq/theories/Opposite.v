(** proof.md, [claim GATE opposite]: for exchanged vertices the same program computes its negative, bit for bit but for
    the signs of zeros and NaN, for all inputs (infinities and overflow included) for which nothing is divided by 0. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN.
Open Scope R_scope.

(** A float without the sign of a zero. *)
Inductive ext := Fin (r : R) | Inf (s : bool) | NaN.
Definition vopp (a : ext) : ext := match a with Fin r => Fin (- r) | Inf s => Inf (negb s) | NaN => NaN end.
Definition sgn (s : bool) (a : ext) : ext := if s then vopp a else a.

Lemma vopp_vopp a : vopp (vopp a) = a.
Proof. destruct a; simpl; rewrite ?Ropp_involutive, ?negb_involutive; reflexivity. Qed.
Lemma sgn_sgn s t a : sgn s (sgn t a) = sgn (xorb s t) a.
Proof. destruct s, t; simpl; rewrite ?vopp_vopp; reflexivity. Qed.

Section Floats.
Variables prec emax : Z.
Context (prec_gt_0_ : Prec_gt_0 prec) (prec_lt_emax_ : Prec_lt_emax prec emax).
Notation float := (binary_float prec emax).
Notation fexp := (SpecFloat.fexp prec emax).
Definition val (x : float) : ext := match x with
  | B754_zero _ => Fin 0 | B754_infinity s => Inf s | B754_nan => NaN | B754_finite _ _ _ _ => Fin (B2R x) end.

Lemma val_finite (x : float) : is_finite x = true -> val x = Fin (B2R x).
Proof. destruct x; simpl; intros; try discriminate; reflexivity. Qed.

Definition fl r := round radix2 fexp (round_mode mode_NE) r.
(** What r is rounded to. *)
Definition rnd r : ext := if Rlt_bool (Rabs (fl r)) (bpow radix2 emax) then Fin (fl r) else Inf (Rlt_bool r 0).

Lemma fl_opp r : fl (- r) = - fl r.
Proof. apply (round_NE_opp radix2 fexp r). Qed.
Lemma fl_0 : fl 0 = 0.
Proof. apply round_0. apply valid_rnd_round_mode. Qed.
Lemma rnd_opp r : rnd (- r) = vopp (rnd r).
Proof.
unfold rnd. rewrite fl_opp, Rabs_Ropp. destruct (Rlt_bool_spec (Rabs (fl r)) (bpow radix2 emax)) as [B | B]; simpl; [reflexivity |].
f_equal. assert (r <> 0).
{ intros ->. rewrite fl_0, Rabs_R0 in B. pose proof (bpow_gt_0 radix2 emax). lra. }
destruct (Rlt_bool_spec r 0), (Rlt_bool_spec (- r) 0); simpl; auto; lra.
Qed.
Lemma overflow s (z : float) : B2SF z = binary_overflow prec emax mode_NE s -> val z = Inf s.
Proof. destruct z; simpl; intros E; inversion E; reflexivity. Qed.

Lemma sign_of (x : float) : is_finite x = true -> B2R x <> 0 -> Bsign x = Rlt_bool (B2R x) 0.
Proof.
destruct x; simpl; try discriminate; intros _ N; try (exfalso; apply N; reflexivity).
symmetry. destruct s; simpl.
- apply Rlt_bool_true. apply F2R_lt_0. reflexivity.
- apply Rlt_bool_false. apply F2R_ge_0. simpl. lia.
Qed.
Lemma not_0 r : bpow radix2 emax <= Rabs (fl r) -> r <> 0.
Proof. intros B ->. rewrite fl_0, Rabs_R0 in B. pose proof (bpow_gt_0 radix2 emax). lra. Qed.

Definition vadd a b := match a, b with
  | NaN, _ | _, NaN => NaN
  | Inf s, Inf t => if Bool.eqb s t then Inf s else NaN
  | Inf s, _ => Inf s | _, Inf t => Inf t
  | Fin x, Fin y => rnd (x + y) end.
Definition is_neg r := Rlt_bool r 0.
Definition vmul a b := match a, b with
  | NaN, _ | _, NaN => NaN
  | Inf s, Inf t => Inf (xorb s t)
  | Inf s, Fin y => if Req_bool y 0 then NaN else Inf (xorb s (is_neg y))
  | Fin x, Inf t => if Req_bool x 0 then NaN else Inf (xorb (is_neg x) t)
  | Fin x, Fin y => rnd (x * y) end.
(** For divisors that are not 0. *)
Definition vdiv a b := match a, b with
  | NaN, _ | _, NaN => NaN
  | Inf _, Inf _ => NaN
  | Inf s, Fin y => Inf (xorb s (is_neg y))
  | Fin x, Inf t => Fin 0
  | Fin x, Fin y => rnd (x / y) end.
Definition vsqrt a := match a with
  | NaN => NaN | Inf s => if s then NaN else Inf false
  | Fin x => if is_neg x then NaN else Fin (fl (sqrt x)) end.
Definition vabs a := match a with NaN => NaN | Inf _ => Inf false | Fin x => Fin (Rabs x) end.
Definition vfma a b c := match a, b, c with
  | Fin x, Fin y, Fin z => rnd (x * y + z)
  | Fin x, Fin y, w => w
  | _, _, _ => vadd (vmul a b) c end.

Lemma val_opp x : val (Bopp x) = vopp (val x).
Proof. destruct x; simpl; try reflexivity; rewrite ?Ropp_0; try reflexivity.
f_equal. rewrite <- F2R_Zopp. destruct s; reflexivity. Qed.

Lemma val_abs x : val (Babs x) = vabs (val x).
Proof. destruct x; simpl; try reflexivity; rewrite ?Rabs_R0; try reflexivity.
f_equal. rewrite <- F2R_Zabs. destruct s; reflexivity. Qed.

Lemma val_add x y : val (Bplus mode_NE x y) = vadd (val x) (val y).
Proof.
destruct (is_finite x) eqn:Fx; [destruct (is_finite y) eqn:Fy |].
- rewrite (val_finite x Fx), (val_finite y Fy). simpl. unfold rnd.
  pose proof (Bplus_correct prec emax _ _ mode_NE x y Fx Fy) as C. fold (fl (B2R x + B2R y)) in C.
  destruct (Rlt_bool_spec (Rabs (fl (B2R x + B2R y))) (bpow radix2 emax)) as [B | B].
  + destruct C as (V & F & _). rewrite val_finite, V by exact F. reflexivity.
  + destruct C as (O & S). rewrite (overflow _ _ O). f_equal.
    apply not_0 in B.
    assert (X : B2R x = 0 \/ B2R x <> 0) by lra. assert (Y : B2R y = 0 \/ B2R y <> 0) by lra.
    destruct X as [X | X], Y as [Y | Y]; try (exfalso; lra).
    * rewrite S, X, Rplus_0_l. apply sign_of; assumption.
    * rewrite Y, Rplus_0_r. apply sign_of; assumption.
    * rewrite (sign_of x Fx X), (sign_of y Fy Y) in S. rewrite (sign_of x Fx X).
      destruct (Rlt_bool_spec (B2R x) 0), (Rlt_bool_spec (B2R y) 0), (Rlt_bool_spec (B2R x + B2R y) 0);
        try reflexivity; try discriminate; lra.
- destruct x, y; try discriminate; reflexivity.
- destruct x, y; try discriminate; try reflexivity. simpl. destruct (Bool.eqb s s0); reflexivity.
Qed.

Lemma xor_neg x y : x <> 0 -> y <> 0 -> xorb (is_neg x) (is_neg y) = is_neg (x * y).
Proof.
intros X Y. unfold is_neg.
destruct (Rlt_bool_spec x 0), (Rlt_bool_spec y 0), (Rlt_bool_spec (x * y) 0); simpl; try reflexivity; exfalso; nra.
Qed.
Lemma inv_neg y : y <> 0 -> is_neg (/ y) = is_neg y.
Proof.
intros Y. unfold is_neg. destruct (Rlt_bool_spec y 0) as [L | L].
- apply Rlt_bool_true, Rinv_lt_0_compat, L.
- apply Rlt_bool_false, Rlt_le, Rinv_0_lt_compat. lra.
Qed.

Lemma val_mul x y : val (Bmult mode_NE x y) = vmul (val x) (val y).
Proof.
destruct (is_finite x) eqn:Fx; [destruct (is_finite y) eqn:Fy |].
- rewrite (val_finite x Fx), (val_finite y Fy). simpl. unfold rnd.
  pose proof (Bmult_correct prec emax _ _ mode_NE x y) as C. fold (fl (B2R x * B2R y)) in C.
  destruct (Rlt_bool_spec (Rabs (fl (B2R x * B2R y))) (bpow radix2 emax)) as [B | B].
  + destruct C as (V & F & _). rewrite Fx, Fy in F. rewrite val_finite, V by exact F. reflexivity.
  + rewrite (overflow _ _ C). f_equal. apply not_0 in B.
    assert (X : B2R x <> 0) by (intros E; apply B; rewrite E; ring).
    assert (Y : B2R y <> 0) by (intros E; apply B; rewrite E; ring).
    rewrite (sign_of x Fx X), (sign_of y Fy Y). apply xor_neg; assumption.
- destruct x as [sx | sx | | sx mx ex bx], y as [sy | sy | | sy my ey by_]; try discriminate; simpl; try reflexivity.
  + rewrite Req_bool_true by reflexivity. reflexivity.
  + pose proof (sign_of (B754_finite sx mx ex bx) eq_refl) as S.
    destruct (Req_bool_spec (F2R (Float radix2 (SpecFloat.cond_Zopp sx (Zpos mx)) ex)) 0) as [E | E].
    * exfalso. apply eq_0_F2R in E. destruct sx; discriminate.
    * simpl in S. unfold is_neg. rewrite <- (S E). reflexivity.
- destruct x as [sx | sx | | sx mx ex bx], y as [sy | sy | | sy my ey by_]; try discriminate; simpl; try reflexivity.
  + rewrite Req_bool_true by reflexivity. reflexivity.
  + pose proof (sign_of (B754_finite sy my ey by_) eq_refl) as S.
    destruct (Req_bool_spec (F2R (Float radix2 (SpecFloat.cond_Zopp sy (Zpos my)) ey)) 0) as [E | E].
    * exfalso. apply eq_0_F2R in E. destruct sy; discriminate.
    * simpl in S. unfold is_neg. rewrite <- (S E). reflexivity.
Qed.

Lemma val_div x y : val y <> Fin 0 -> val (Bdiv mode_NE x y) = vdiv (val x) (val y).
Proof.
intros N0. destruct (is_finite y) eqn:Fy.
- assert (Y : B2R y <> 0) by (intros E; apply N0; rewrite (val_finite y Fy), E; reflexivity).
  destruct (is_finite x) eqn:Fx.
  + rewrite (val_finite x Fx), (val_finite y Fy). simpl. unfold rnd.
    pose proof (Bdiv_correct prec emax _ _ mode_NE x y Y) as C. fold (fl (B2R x / B2R y)) in C.
    destruct (Rlt_bool_spec (Rabs (fl (B2R x / B2R y))) (bpow radix2 emax)) as [B | B].
    * destruct C as (V & F & _). rewrite Fx in F. rewrite val_finite, V by exact F. reflexivity.
    * rewrite (overflow _ _ C). f_equal. apply not_0 in B.
      assert (X : B2R x <> 0) by (intros E; apply B; rewrite E; unfold Rdiv; ring).
      rewrite (sign_of x Fx X), (sign_of y Fy Y). unfold Rdiv.
      fold (is_neg (B2R x)) (is_neg (B2R y)) (is_neg (B2R x * / B2R y)).
      rewrite <- (inv_neg (B2R y) Y). apply xor_neg; [exact X | apply Rinv_neq_0_compat, Y].
  + destruct x as [sx | sx | | sx mx ex bx], y as [sy | sy | | sy my ey by_]; try discriminate; simpl; try reflexivity;
      try (exfalso; apply Y; reflexivity).
    pose proof (sign_of (B754_finite sy my ey by_) eq_refl Y) as S. simpl in S. unfold is_neg. rewrite <- S. reflexivity.
- destruct x, y; try discriminate; reflexivity.
Qed.

Lemma val_sqrt x : val (Bsqrt mode_NE x) = vsqrt (val x).
Proof.
destruct x as [s | s | | s m e b].
- simpl. unfold is_neg. rewrite Rlt_bool_false, sqrt_0, fl_0 by lra. reflexivity.
- destruct s; reflexivity.
- reflexivity.
- pose proof (Bsqrt_correct prec emax _ _ mode_NE (B754_finite s m e b)) as (V & F & _).
  pose proof (sign_of (B754_finite s m e b) eq_refl) as S.
  assert (N : B2R (B754_finite s m e b) <> 0).
  { simpl. intros E. apply eq_0_F2R in E. destruct s; discriminate. }
  specialize (S N). rewrite (val_finite (B754_finite s m e b) eq_refl).
  unfold vsqrt, is_neg. rewrite <- S. destruct s.
  + reflexivity.
  + rewrite val_finite, V by exact F. reflexivity.
Qed.

Lemma finite_neg s m e (b : SpecFloat.bounded prec emax m e = true) : is_neg (F2R (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) e)) = s
  /\ Req_bool (F2R (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) e)) 0 = false.
Proof.
assert (N : F2R (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) e) <> 0).
{ intros E. apply eq_0_F2R in E. destruct s; discriminate. }
split; [| apply Req_bool_false; exact N].
symmetry. exact (sign_of (B754_finite s m e b) eq_refl N).
Qed.

Lemma val_fma x y z : val (Bfma mode_NE x y z) = vfma (val x) (val y) (val z).
Proof.
destruct (is_finite x && is_finite y && is_finite z)%bool eqn:F.
- apply andb_prop in F. destruct F as [F Fz]. apply andb_prop in F. destruct F as [Fx Fy].
  rewrite (val_finite x Fx), (val_finite y Fy), (val_finite z Fz). simpl. unfold rnd.
  pose proof (Bfma_correct prec emax _ _ mode_NE x y z Fx Fy Fz) as C. cbv zeta in C.
  fold (fl (B2R x * B2R y + B2R z)) in C.
  destruct (Rlt_bool_spec (Rabs (fl (B2R x * B2R y + B2R z))) (bpow radix2 emax)) as [B | B].
  + destruct C as (V & F & _). rewrite val_finite, V by exact F. reflexivity.
  + rewrite (overflow _ _ C). reflexivity.
- destruct x as [sx | sx | | sx mx ex bx], y as [sy | sy | | sy my ey by_], z as [sz | sz | | sz mz ez bz]; try discriminate F; simpl;
    repeat match goal with
    | b : SpecFloat.bounded _ _ ?m ?e = true |- context [is_neg (F2R (Float radix2 (SpecFloat.cond_Zopp ?s (Zpos ?m)) ?e))] =>
        rewrite (proj1 (finite_neg s m e b))
    | b : SpecFloat.bounded _ _ ?m ?e = true |- context [Req_bool (F2R (Float radix2 (SpecFloat.cond_Zopp ?s (Zpos ?m)) ?e)) 0] =>
        rewrite (proj2 (finite_neg s m e b))
    end; rewrite ?Req_bool_true by reflexivity; simpl; try reflexivity;
    match goal with |- context [Bool.eqb ?a ?b] => destruct (Bool.eqb a b) eqn:EE; try apply eqb_prop in EE; subst; reflexivity end.
Qed.

(** ** Laws *)
Lemma vadd_comm a b : vadd a b = vadd b a.
Proof. destruct a, b; simpl; try reflexivity; [rewrite Rplus_comm; reflexivity |]. destruct s, s0; reflexivity. Qed.
Lemma vadd_opp a b : vadd (vopp a) (vopp b) = vopp (vadd a b).
Proof.
destruct a, b; simpl; try reflexivity; [| destruct s, s0; reflexivity].
rewrite <- rnd_opp. f_equal. ring.
Qed.
Lemma vmul_comm a b : vmul a b = vmul b a.
Proof.
destruct a, b; simpl; try reflexivity; [rewrite Rmult_comm; reflexivity | | | ]; rewrite ?(xorb_comm _ (is_neg _)), ?(xorb_comm s s0); reflexivity.
Qed.
Lemma neg_opp x : x <> 0 -> is_neg (- x) = negb (is_neg x).
Proof. intros N. unfold is_neg. destruct (Rlt_bool_spec x 0), (Rlt_bool_spec (- x) 0); simpl; try reflexivity; lra. Qed.
Lemma vmul_opp_l a b : vmul (vopp a) b = vopp (vmul a b).
Proof.
destruct a as [x | s | ], b as [y | t | ]; simpl; try reflexivity.
- rewrite <- rnd_opp. f_equal. ring.
- destruct (Req_bool_spec x 0) as [-> | N].
  + rewrite Req_bool_true by lra. reflexivity.
  + rewrite Req_bool_false by lra. rewrite neg_opp by exact N. simpl. rewrite negb_xorb_l. reflexivity.
- destruct (Req_bool y 0); simpl; [reflexivity |]. rewrite negb_xorb_l. reflexivity.
- rewrite negb_xorb_l. reflexivity.
Qed.
Lemma vmul_opp_r a b : vmul a (vopp b) = vopp (vmul a b).
Proof. rewrite vmul_comm, vmul_opp_l, vmul_comm. reflexivity. Qed.
Lemma vdiv_opp_l a b : vdiv (vopp a) b = vopp (vdiv a b).
Proof.
destruct a as [x | s | ], b as [y | t | ]; simpl; try reflexivity.
- rewrite <- rnd_opp. f_equal. unfold Rdiv. ring.
- rewrite Ropp_0. reflexivity.
- rewrite negb_xorb_l. reflexivity.
Qed.
Lemma vdiv_opp_r a b : b <> Fin 0 -> vdiv a (vopp b) = vopp (vdiv a b).
Proof.
intros N. assert (Y : forall y, b = Fin y -> y <> 0) by (intros y -> ->; apply N; reflexivity).
destruct a as [x | s | ], b as [y | t | ]; simpl; try reflexivity.
- rewrite <- rnd_opp. f_equal. specialize (Y y eq_refl). field. exact Y.
- rewrite Ropp_0. reflexivity.
- rewrite neg_opp, negb_xorb_r by (apply Y; reflexivity). reflexivity.
Qed.
Lemma vfma_comm a b c : vfma a b c = vfma b a c.
Proof.
assert (G : vadd (vmul a b) c = vadd (vmul b a) c) by (rewrite (vmul_comm a b); reflexivity).
destruct a, b, c; try exact G; simpl; try reflexivity. f_equal. ring.
Qed.
Lemma vfma_opp a b c : vfma (vopp a) b (vopp c) = vopp (vfma a b c).
Proof.
assert (G : vadd (vmul (vopp a) b) (vopp c) = vopp (vadd (vmul a b) c)) by (rewrite vmul_opp_l; apply vadd_opp).
destruct a, b, c; try exact G; simpl; try reflexivity.
rewrite <- rnd_opp. f_equal. ring.
Qed.
Lemma vfma_opp2 a b c : vfma (vopp a) (vopp b) c = vfma a b c.
Proof.
assert (G : vadd (vmul (vopp a) (vopp b)) c = vadd (vmul a b) c) by (rewrite vmul_opp_l, vmul_opp_r, vopp_vopp; reflexivity).
destruct a, b, c; try exact G; simpl; try reflexivity. f_equal. ring.
Qed.

(** ** Programs *)
Inductive tm := In (i : nat) | Num (x : float) | Neg (a : tm) | Abs (a : tm) | Sqrt (a : tm)
  | Add (a b : tm) | Sub (a b : tm) | Mul (a b : tm) | Div (a b : tm) | Fma (a b c : tm).

Fixpoint run (inp : nat -> float) (t : tm) : float := match t with
  | In i => inp i | Num x => x | Neg a => Bopp (run inp a) | Abs a => Babs (run inp a)
  | Sqrt a => Bsqrt mode_NE (run inp a)
  | Add a b => Bplus mode_NE (run inp a) (run inp b)
  | Sub a b => Bplus mode_NE (run inp a) (Bopp (run inp b))
  | Mul a b => Bmult mode_NE (run inp a) (run inp b)
  | Div a b => Bdiv mode_NE (run inp a) (run inp b)
  | Fma a b c => Bfma mode_NE (run inp a) (run inp b) (run inp c) end.

Fixpoint defined (inp : nat -> float) (t : tm) : Prop := match t with
  | In _ | Num _ => True | Neg a | Abs a | Sqrt a => defined inp a
  | Add a b | Sub a b | Mul a b => defined inp a /\ defined inp b
  | Div a b => defined inp a /\ defined inp b /\ val (run inp b) <> Fin 0
  | Fma a b c => defined inp a /\ defined inp b /\ defined inp c end.

Fixpoint rename (f : nat -> nat) (t : tm) : tm := match t with
  | In i => In (f i) | Num x => Num x | Neg a => Neg (rename f a) | Abs a => Abs (rename f a) | Sqrt a => Sqrt (rename f a)
  | Add a b => Add (rename f a) (rename f b) | Sub a b => Sub (rename f a) (rename f b)
  | Mul a b => Mul (rename f a) (rename f b) | Div a b => Div (rename f a) (rename f b)
  | Fma a b c => Fma (rename f a) (rename f b) (rename f c) end.

Lemma run_rename inp f t : run inp (rename f t) = run (fun i => inp (f i)) t.
Proof. induction t; simpl; rewrite ?IHt, ?IHt1, ?IHt2, ?IHt3; reflexivity. Qed.
Lemma defined_rename inp f t : defined inp (rename f t) <-> defined (fun i => inp (f i)) t.
Proof. induction t; simpl; rewrite ?IHt, ?IHt1, ?IHt2, ?IHt3, ?run_rename; tauto. Qed.

Fixpoint strip (t : tm) : bool * tm := match t with Neg a => let (s, c) := strip a in (negb s, c) | _ => (false, t) end.

(** Does b compute a, or with s its negative, by rules of signs and order alone? *)
Fixpoint alike (s : bool) (a b : tm) : bool :=
  match a with
  | Neg a => alike (negb s) a b
  | _ => let (t, c) := strip b in let r := xorb s t in
    match a, c with
    | In i, In j => negb r && Nat.eqb i j
    | Abs a, Abs b => negb r && (alike false a b || alike true a b)
    | Sqrt a, Sqrt b => negb r && alike false a b
    | Add a1 a2, Add b1 b2 | Sub a1 a2, Sub b1 b2 =>
        let q := match a with Sub _ _ => negb r | _ => r end in
        alike r a1 b1 && alike r a2 b2 || alike q a1 b2 && alike q a2 b1
    | Add a1 a2, Sub b1 b2 | Sub a1 a2, Add b1 b2 =>
        let first := match a with Sub _ _ => true | _ => false end in
        alike r a1 b1 && alike (negb r) a2 b2
        || (if first then alike r a1 b2 && alike (negb r) a2 b1 else alike (negb r) a1 b2 && alike r a2 b1)
    | Mul a1 a2, Mul b1 b2 =>
        alike false a1 b1 && alike r a2 b2 || alike true a1 b1 && alike (negb r) a2 b2
        || alike false a1 b2 && alike r a2 b1 || alike true a1 b2 && alike (negb r) a2 b1
    | Div a1 a2, Div b1 b2 => alike false a1 b1 && alike r a2 b2 || alike true a1 b1 && alike (negb r) a2 b2
    | Fma a1 a2 a3, Fma b1 b2 b3 => alike r a3 b3 &&
       (alike false a1 b1 && alike r a2 b2 || alike true a1 b1 && alike (negb r) a2 b2
        || alike false a1 b2 && alike r a2 b1 || alike true a1 b2 && alike (negb r) a2 b1)
    | _, _ => false
    end
  end.

Lemma strip_ok inp t : val (run inp t) = sgn (fst (strip t)) (val (run inp (snd (strip t)))) /\ (defined inp t -> defined inp (snd (strip t))).
Proof.
induction t; simpl; auto. destruct (strip t) as [s c]. simpl in *. destruct IHt as [E D]. split; [| exact D].
rewrite val_opp, E. destruct s; simpl; rewrite ?vopp_vopp; reflexivity.
Qed.

Lemma sgn_add s a b : vadd (sgn s a) (sgn s b) = sgn s (vadd a b).
Proof. destruct s; simpl; [apply vadd_opp | reflexivity]. Qed.
Lemma sgn_mul s t a b : vmul (sgn s a) (sgn t b) = sgn (xorb s t) (vmul a b).
Proof. destruct s, t; simpl; rewrite ?vmul_opp_l, ?vmul_opp_r, ?vopp_vopp; reflexivity. Qed.
Lemma sgn_div s t a b : b <> Fin 0 -> vdiv (sgn s a) (sgn t b) = sgn (xorb s t) (vdiv a b).
Proof.
intros N. destruct s, t; simpl; rewrite ?vdiv_opp_l, ?(vdiv_opp_r _ _ N), ?vopp_vopp; reflexivity.
Qed.
Lemma sgn_fma s t a b c : vfma (sgn s a) (sgn t b) (sgn (xorb s t) c) = sgn (xorb s t) (vfma a b c).
Proof.
destruct s, t; simpl.
- apply vfma_opp2.
- apply vfma_opp.
- rewrite vfma_comm, vfma_opp, vfma_comm. reflexivity.
- reflexivity.
Qed.
Lemma vopp_sgn s a : vopp (sgn s a) = sgn (negb s) a.
Proof. destruct s; simpl; rewrite ?vopp_vopp; reflexivity. Qed.
Lemma vabs_sgn s a : vabs (sgn s a) = vabs a.
Proof. destruct s, a; simpl; rewrite ?Rabs_Ropp; reflexivity. Qed.


Ltac split_or A := repeat (apply orb_prop in A; destruct A as [A | A]).
Ltac both A := apply andb_prop in A; let X := fresh "X" in let Y := fresh "Y" in destruct A as [X Y].
Ltac push := rewrite <- ?vadd_opp, ?vopp_vopp; first [reflexivity | apply vadd_comm].
Ltac pull N := rewrite ?vmul_opp_l, ?vmul_opp_r, ?vdiv_opp_l, ?(vdiv_opp_r _ _ N), ?vopp_vopp; first [reflexivity | apply vmul_comm | f_equal; apply vmul_comm].

Theorem alike_ok inp a : forall s b, alike s a b = true -> defined inp a -> defined inp b ->
  val (run inp b) = sgn s (val (run inp a)).
Proof.
induction a as [i | x | a IH | a IH | a IH | a1 IH1 a2 IH2 | a1 IH1 a2 IH2 | a1 IH1 a2 IH2 | a1 IH1 a2 IH2 | a1 IH1 a2 IH2 a3 IH3];
  intros s b A Da Db.
3: { (* Neg *)
  simpl in A. rewrite (IH _ _ A Da Db). simpl. rewrite val_opp. destruct s; simpl; rewrite ?vopp_vopp; reflexivity. }
all: simpl in A; destruct (strip_ok inp b) as [E D]; specialize (D Db); destruct (strip b) as [t c]; simpl in E, D;
  rewrite E; clear E Db b; rename D into Db;
  destruct c as [j | y | b | b | b | b1 b2 | b1 b2 | b1 b2 | b1 b2 | b1 b2 b3]; try discriminate A; simpl in Da, Db; simpl run.
- (* In *)
  both A. apply Nat.eqb_eq in Y. subst. apply negb_true_iff, xorb_eq in X. subst. reflexivity.
- (* Abs *)
  both A. apply negb_true_iff, xorb_eq in X. subst. rewrite !val_abs. f_equal.
  split_or Y; rewrite (IH _ _ Y Da Db), vabs_sgn; reflexivity.
- (* Sqrt *)
  both A. apply negb_true_iff, xorb_eq in X. subst. rewrite !val_sqrt. f_equal. rewrite (IH _ _ Y Da Db). reflexivity.
- (* Add, Add *)
  destruct Da as [D1 D2], Db as [D3 D4]. rewrite !val_add.
  split_or A; both A;
  [rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4) | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D3)];
  destruct s, t; simpl; push.
- (* Add, Sub *)
  destruct Da as [D1 D2], Db as [D3 D4]. rewrite !val_add, !val_opp.
  split_or A; both A;
  [rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4) | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D3)];
  destruct s, t; simpl; push.
- (* Sub, Add *)
  destruct Da as [D1 D2], Db as [D3 D4]. rewrite !val_add, !val_opp.
  split_or A; both A;
  [rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4) | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D3)];
  destruct s, t; simpl; push.
- (* Sub, Sub *)
  destruct Da as [D1 D2], Db as [D3 D4]. rewrite !val_add, !val_opp.
  split_or A; both A;
  [rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4) | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D3)];
  destruct s, t; simpl; push.
- (* Mul *)
  destruct Da as [D1 D2], Db as [D3 D4]. rewrite !val_mul.
  assert (N : Inf true <> Fin 0) by discriminate.
  split_or A; both A;
  [rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4) | rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4)
  | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D3) | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D3)];
  destruct s, t; simpl; pull N.
- (* Div *)
  destruct Da as (D1 & D2 & N), Db as (D3 & D4 & N'). rewrite !val_div by assumption.
  split_or A; both A; rewrite (IH1 _ _ X D1 D3), (IH2 _ _ Y D2 D4); destruct s, t; simpl; pull N.
- (* Fma *)
  destruct Da as (D1 & D2 & D3), Db as (D4 & D5 & D6). rewrite !val_fma.
  apply andb_prop in A. destruct A as [Z A]. rewrite (IH3 _ _ Z D3 D6).
  split_or A; both A;
  [rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D5) | rewrite (IH1 _ _ X D1 D4), (IH2 _ _ Y D2 D5)
  | rewrite (IH1 _ _ X D1 D5), (IH2 _ _ Y D2 D4), vfma_comm | rewrite (IH1 _ _ X D1 D5), (IH2 _ _ Y D2 D4), vfma_comm];
  destruct s, t; simpl;
  first [reflexivity | rewrite vfma_opp2, ?vopp_vopp; reflexivity | rewrite vfma_opp, ?vopp_vopp; reflexivity
        | rewrite vfma_comm, vfma_opp, vfma_comm, ?vopp_vopp; reflexivity].
Qed.

(** The claim: with inputs exchanged by f, the program computes its negative. *)
Theorem opposite f t : alike true t (rename f t) = true ->
  forall inp, defined inp t -> defined (fun i => inp (f i)) t ->
  val (run (fun i => inp (f i)) t) = vopp (val (run inp t)).
Proof.
intros A inp D1 D2. rewrite <- run_rename.
apply (alike_ok inp t true (rename f t) A D1). apply defined_rename, D2.
Qed.
End Floats.
