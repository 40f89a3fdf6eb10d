(** proof.md, "Quotients" and "Two quotients by one divisor". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Hairline Require Import Rounding.
Open Scope R_scope.

Definition when (b : bool) (x : R) := if b then x else 0.

Section Quotients.
Variables (p s : Z).
Hypothesis Hp : (1 <= p)%Z.
Variable choice : Z -> bool.
Notation fl := (fl p s choice).
Notation u := (u p).
Notation tau := (tau s).
Notation H := (H p s).
Notation is_float := (is_float p s).

(** hat is star, or star with one rounding that the formula leaves out. *)
Definition left_out (k : bool) (star hat : R) := if k then hat = fl star else hat = star.

Lemma left_out_error k star hat : left_out k star hat ->
  Rabs (hat - star) <= when k (u * Rabs star + tau).
Proof.
destruct k; simpl; intros ->.
- apply fl_error; assumption.
- rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra.
Qed.

(** The divisor: exact d, computed dh, what its last operation rounds ds. *)
Variables (phi Ed Eds d ds dh : R) (kd : bool).
Hypothesis floor : phi <= Rabs d.
Hypothesis lemma_d : Rabs (dh - d) <= Ed.
Hypothesis lemma_ds : Rabs (ds - d) <= Eds.
Hypothesis last_d : left_out kd ds dh.
Hypothesis safe : 2 * tau < phi - Ed.
(** Not stated in proof.md: it follows there from Eds <= Ed, which is so by how a lemma is made, not by what it says. *)
Hypothesis safe_star : 0 < phi - Eds.

Definition least := phi - Ed.
Definition eps := u + tau / least.
Definition share := eps / (1 - eps).

Let tau0 : 0 < tau := tau_pos s.
Let u0 : 0 < u := u_pos p.
Let u1 : u <= / 2 := u_half p Hp.

Lemma least_pos : 0 < least. Proof. unfold least; lra. Qed.
Lemma of_tiny_pos : 0 < tau / least.
Proof. apply Rdiv_lt_0_compat; [lra | apply least_pos]. Qed.
Lemma of_tiny_half : tau / least < / 2.
Proof.
apply Rmult_lt_reg_r with least; [apply least_pos |].
unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by (pose proof least_pos; lra). unfold least; lra.
Qed.
Lemma eps_range : u < eps < 1.
Proof. unfold eps. pose proof of_tiny_pos; pose proof of_tiny_half; lra. Qed.
Lemma share_eq : share * (1 - eps) = eps.
Proof. unfold share. pose proof eps_range. field. lra. Qed.
Lemma share_eps : eps <= share.
Proof. pose proof share_eq; pose proof eps_range. assert (0 < share).
{ unfold share. apply Rdiv_lt_0_compat; lra. } nra. Qed.

Lemma least_dh : least <= Rabs dh.
Proof.
pose proof (Rabs_triang_inv d (d - dh)) as T. replace (d - (d - dh)) with dh in T by ring.
rewrite Rabs_minus_sym in lemma_d. unfold least. lra.
Qed.
Lemma least_ds : phi - Eds <= Rabs ds.
Proof.
pose proof (Rabs_triang_inv d (d - ds)) as T. replace (d - (d - ds)) with ds in T by ring.
rewrite Rabs_minus_sym in lemma_ds. lra.
Qed.
Lemma dh_not_0 : dh <> 0.
Proof. intros E. pose proof least_dh as L. rewrite E, Rabs_R0 in L. pose proof least_pos; lra. Qed.
Lemma ds_not_0 : ds <> 0.
Proof. intros E. pose proof least_ds as L. rewrite E, Rabs_R0 in L. lra. Qed.

Lemma by_dh x c : Rabs x <= c -> 0 <= c -> Rabs (x / dh) <= c / least.
Proof.
intros Hx Hc. unfold Rdiv. rewrite Rabs_mult, Rabs_inv.
apply Rmult_le_compat; try assumption; try apply Rabs_pos.
- apply Rlt_le, Rinv_0_lt_compat. pose proof least_dh; pose proof least_pos; lra.
- apply Rinv_le_contravar; [apply least_pos | apply least_dh].
Qed.

(** The divisor's last rounding changes a quotient by at most [share] of it. *)
Lemma turned : Rabs (ds / dh - 1) <= when kd share.
Proof.
pose proof (left_out_error _ _ _ last_d) as E. destruct kd; simpl in *.
2: { rewrite last_d. unfold Rdiv. rewrite Rinv_r, Rminus_diag_eq, Rabs_R0 by (try apply ds_not_0; reflexivity). lra. }
replace (ds / dh - 1) with ((ds - dh) / dh) by (field; apply dh_not_0).
pose proof least_dh as L. pose proof least_pos as L0.
unfold Rdiv at 1. rewrite Rabs_mult, Rabs_inv.
apply Rmult_le_reg_r with (Rabs dh); [lra |].
rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
rewrite Rabs_minus_sym in E.
assert (T : Rabs ds <= Rabs dh + Rabs (ds - dh)).
{ pose proof (Rabs_triang dh (ds - dh)) as T. replace (dh + (ds - dh)) with ds in T by ring. exact T. }
assert (P : tau <= tau / least * Rabs dh).
{ apply Rle_trans with (tau / least * least).
  - unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - apply Rmult_le_compat_l; [apply Rlt_le, of_tiny_pos | exact L]. }
pose proof eps_range as ER. pose proof (Rabs_pos (ds - dh)) as X0.
set (x := Rabs (ds - dh)) in *.
assert (X : x * (1 - u) <= eps * Rabs dh) by (unfold eps; nra).
apply Rmult_le_reg_r with (1 - eps); [lra |].
replace (share * Rabs dh * (1 - eps)) with (share * (1 - eps) * Rabs dh) by ring.
rewrite share_eq. nra.
Qed.

Section One.
Variables (Q first_rest n q ns nh : R) (kn : bool).
Hypothesis exact : n = q * d.
Hypothesis most : Rabs q <= Q.
Hypothesis formula : Rabs (ns - q * ds) <= first_rest.
Hypothesis last_n : left_out kn ns nh.

Definition C := first_rest / (phi - Eds).

Lemma star_error : Rabs (ns / ds - q) <= C.
Proof.
replace (ns / ds - q) with ((ns - q * ds) / ds) by (field; apply ds_not_0).
unfold C, Rdiv. rewrite Rabs_mult, Rabs_inv.
pose proof least_ds.
apply Rmult_le_compat; try apply Rabs_pos; try assumption.
- apply Rlt_le, Rinv_0_lt_compat. lra.
- apply Rinv_le_contravar; assumption.
Qed.

Definition count := when kn 1 + when kd 1.
Definition B := C + count * share * (Q + C) + when (kn || kd) (tau / least).

(** The quotient before its own rounding. *)
Theorem before : Rabs (nh / dh - q) <= B.
Proof.
pose proof star_error as S. set (w := ns / ds) in *.
assert (W : Rabs w <= Q + C).
{ pose proof (Rabs_triang q (w - q)) as T. replace (q + (w - q)) with w in T by ring. lra. }
pose proof turned as T. set (t := ds / dh) in *.
pose proof (left_out_error _ _ _ last_n) as N.
assert (NS : ns = w * ds) by (unfold w; field; apply ds_not_0).
assert (E : nh / dh - q = (w - q) + w * (t - 1) + (nh - ns) / dh).
{ rewrite NS. unfold t. field. apply dh_not_0. }
rewrite E. clear E.
apply Rle_trans with (1 := Rabs_triang _ _).
apply Rle_trans with (1 := Rplus_le_compat_r _ _ _ (Rabs_triang _ _)).
rewrite Rabs_mult.
assert (N' : Rabs ((nh - ns) / dh) <= when kn (u * (Rabs w * (1 + when kd share)) + tau / least)).
{ destruct kn; simpl in *.
  2: { rewrite last_n, Rminus_diag_eq by reflexivity. unfold Rdiv. rewrite Rmult_0_l, Rabs_R0. lra. }
  unfold Rdiv at 1. rewrite Rabs_mult, Rabs_inv.
  pose proof least_dh as L; pose proof least_pos as L0.
  apply Rle_trans with ((u * Rabs ns + tau) * / Rabs dh).
  { apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra | exact N]. }
  rewrite Rmult_plus_distr_r. apply Rplus_le_compat.
  - rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra |].
    rewrite NS, Rabs_mult, Rmult_assoc. apply Rmult_le_compat_l; [apply Rabs_pos |].
    replace (Rabs ds * / Rabs dh) with (Rabs t) by (unfold t, Rdiv; rewrite Rabs_mult, Rabs_inv; reflexivity).
    pose proof (Rabs_triang 1 (t - 1)) as TT. replace (1 + (t - 1)) with t in TT by ring.
    rewrite Rabs_R1 in TT. lra.
  - apply Rmult_le_compat_l; [lra |]. apply Rinv_le_contravar; assumption. }
assert (WT : Rabs w * Rabs (t - 1) <= Rabs w * when kd share).
{ apply Rmult_le_compat_l; [apply Rabs_pos | exact T]. }
unfold B, count. pose proof eps_range as ER. pose proof share_eq as SE. pose proof share_eps as SP.
pose proof of_tiny_pos as TP. pose proof (Rabs_pos w) as W0.
assert (K1 : u * (1 + share) <= share) by nra.
destruct kn, kd; simpl in *; nra.
Qed.

Definition V := Q + B.
Lemma before_size : Rabs (nh / dh) <= V.
Proof.
pose proof before as P. pose proof (Rabs_triang q (nh / dh - q)) as T.
replace (q + (nh / dh - q)) with (nh / dh) in T by ring. unfold V. lra.
Qed.

(** quotient *)
Theorem quotient e : V <= bpow radix2 e -> Rabs (fl (nh / dh) - q) <= B + H e.
Proof.
intros He. pose proof before as P.
pose proof (fl_half_ulp p s Hp choice (nh / dh) e (Rle_trans _ _ _ before_size He)) as R.
pose proof (Rabs_triang (fl (nh / dh) - nh / dh) (nh / dh - q)) as T.
replace (fl (nh / dh) - nh / dh + (nh / dh - q)) with (fl (nh / dh) - q) in T by ring. lra.
Qed.
Theorem quotient_computed f : is_float f -> V <= f -> Rabs (fl (nh / dh)) <= f.
Proof. intros G F. apply fl_le_float; try assumption. pose proof before_size; lra. Qed.

(** quotient-by-reciprocal *)
Variable m : R.
Hypothesis computed_n : Rabs nh <= m.
Definition Rec := u * V + tau * m.
Lemma reciprocal_error x : Rabs (nh / dh) <= x -> Rabs (nh * fl (1 / dh) - nh / dh) <= u * x + tau * m.
Proof.
intros X. pose proof (fl_error p s Hp choice (1 / dh)) as E.
replace (nh * fl (1 / dh) - nh / dh) with (nh * (fl (1 / dh) - 1 / dh)) by (field; apply dh_not_0).
rewrite Rabs_mult.
apply Rle_trans with (Rabs nh * (u * Rabs (1 / dh) + tau)).
{ apply Rmult_le_compat_l; [apply Rabs_pos | exact E]. }
replace (Rabs nh * (u * Rabs (1 / dh) + tau)) with (u * Rabs (nh / dh) + tau * Rabs nh).
2: { unfold Rdiv. rewrite !Rabs_mult, Rabs_R1. ring. }
apply Rplus_le_compat; apply Rmult_le_compat_l; try assumption; lra.
Qed.
Lemma reciprocal_before : Rabs (nh * fl (1 / dh) - q) <= B + Rec.
Proof.
pose proof before as P. pose proof (reciprocal_error V before_size) as R. fold Rec in R.
pose proof (Rabs_triang (nh * fl (1 / dh) - nh / dh) (nh / dh - q)) as T.
replace (nh * fl (1 / dh) - nh / dh + (nh / dh - q)) with (nh * fl (1 / dh) - q) in T by ring. lra.
Qed.
Lemma reciprocal_size : Rabs (nh * fl (1 / dh)) <= V + Rec.
Proof.
pose proof reciprocal_before as P. pose proof (Rabs_triang q (nh * fl (1 / dh) - q)) as T.
replace (q + (nh * fl (1 / dh) - q)) with (nh * fl (1 / dh)) in T by ring. unfold V. lra.
Qed.
Theorem quotient_by_reciprocal e : V + Rec <= bpow radix2 e ->
  Rabs (fl (nh * fl (1 / dh)) - q) <= B + Rec + H e.
Proof.
intros He. pose proof reciprocal_before as P.
pose proof (fl_half_ulp p s Hp choice _ e (Rle_trans _ _ _ reciprocal_size He)) as R.
set (x := nh * fl (1 / dh)) in *.
pose proof (Rabs_triang (fl x - x) (x - q)) as T.
replace (fl x - x + (x - q)) with (fl x - q) in T by ring. lra.
Qed.
End One.

(** Two quotients by this divisor: u and v with their own lemmas; Eu bounds the error of n^/d^ too. *)
Section Two.
Variables (Q first_rest qu qv ns ms nh mh : R) (kn km : bool).
Hypothesis most : Rabs (qu + qv) <= Q.
Hypothesis formula : Rabs (ns + ms - (qu + qv) * ds) <= first_rest.
Hypothesis last_n : left_out kn ns nh.
Hypothesis last_m : left_out km ms mh.
Variables (Qu Eu Qv Ev : R).
Hypothesis size_u : Rabs qu <= Qu.
Hypothesis size_v : Rabs qv <= Qv.
Hypothesis before_u : Rabs (nh / dh - qu) <= Eu.
Hypothesis before_v : Rabs (mh / dh - qv) <= Ev.

Definition CC := first_rest / (phi - Eds).
Definition P Qx Ex := (Qx + Ex + tau / least) * (1 + 2 * share).
Definition of_numerator (k : bool) Px := when k (share * Px + tau / least).
(** B of the sum before the roundings of u and v themselves. *)
Definition B_both := CC + when kd (share * (Q + CC) + tau / least)
  + of_numerator kn (P Qu Eu) + of_numerator km (P Qv Ev).

Lemma P_bounds (k : bool) qx Qx Ex xs xh : left_out k xs xh -> Rabs qx <= Qx -> Rabs (xh / dh - qx) <= Ex ->
  Rabs (xh / dh) <= P Qx Ex /\ Rabs ((xh - xs) / dh) <= of_numerator k (P Qx Ex).
Proof.
intros L Sx Bx.
assert (X : Rabs (xh / dh) <= Qx + Ex).
{ pose proof (Rabs_triang qx (xh / dh - qx)) as T. replace (qx + (xh / dh - qx)) with (xh / dh) in T by ring. lra. }
pose proof (Rabs_pos (xh / dh)) as X0. pose proof of_tiny_pos as TP.
pose proof eps_range as ER. pose proof share_eq as SE. pose proof share_eps as SP.
split; [unfold P; nra |].
pose proof (left_out_error _ _ _ L) as N. destruct k; simpl in *.
2: { rewrite L, Rminus_diag_eq by reflexivity. unfold Rdiv. rewrite Rmult_0_l, Rabs_R0. lra. }
pose proof least_dh as Ld; pose proof least_pos as L0.
(* |xs/dh| (1-u) <= |xh/dh| + tau/least *)
assert (Y : Rabs ((xh - xs) / dh) <= u * Rabs (xs / dh) + tau / least).
{ unfold Rdiv. rewrite !Rabs_mult, !Rabs_inv.
  apply Rle_trans with ((u * Rabs xs + tau) * / Rabs dh).
  { apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra | exact N]. }
  rewrite Rmult_plus_distr_r. apply Rplus_le_compat; [lra |].
  apply Rmult_le_compat_l; [lra |]. apply Rinv_le_contravar; assumption. }
assert (Z : Rabs (xs / dh) <= Rabs (xh / dh) + Rabs ((xh - xs) / dh)).
{ pose proof (Rabs_triang (xh / dh) (- ((xh - xs) / dh))) as T. rewrite Rabs_Ropp in T.
  replace (xh / dh + - ((xh - xs) / dh)) with (xs / dh) in T by (field; apply dh_not_0). exact T. }
set (y := Rabs ((xh - xs) / dh)) in *. set (z := Rabs (xs / dh)) in *. set (h := Rabs (xh / dh)) in *.
set (t := tau / least) in *.
assert (ZU : z * (1 - u) <= Qx + Ex + t) by nra.
assert (ZP : z <= P Qx Ex).
{ apply Rmult_le_reg_r with (1 - u); [lra |]. apply Rle_trans with (1 := ZU). unfold P. fold t.
  assert (1 <= (1 + 2 * share) * (1 - u)) by nra. assert (0 <= Qx + Ex + t) by lra. nra. }
unfold of_numerator. assert (0 <= z) by apply Rabs_pos. assert (u <= share) by lra. simpl. nra.
Qed.

Theorem both_before : Rabs (nh / dh + mh / dh - (qu + qv)) <= B_both.
Proof.
assert (S : Rabs ((ns + ms) / ds - (qu + qv)) <= CC).
{ replace ((ns + ms) / ds - (qu + qv)) with ((ns + ms - (qu + qv) * ds) / ds) by (field; apply ds_not_0).
  unfold CC, Rdiv. rewrite Rabs_mult, Rabs_inv. pose proof least_ds.
  apply Rmult_le_compat; try apply Rabs_pos; try assumption.
  - apply Rlt_le, Rinv_0_lt_compat. lra.
  - apply Rinv_le_contravar; assumption. }
set (w := (ns + ms) / ds) in *.
assert (W : Rabs w <= Q + CC).
{ pose proof (Rabs_triang (qu + qv) (w - (qu + qv))) as T.
  replace (qu + qv + (w - (qu + qv))) with w in T by ring. lra. }
pose proof turned as T. set (t := ds / dh) in *.
destruct (P_bounds kn qu Qu Eu ns nh last_n size_u before_u) as [_ N].
destruct (P_bounds km qv Qv Ev ms mh last_m size_v before_v) as [_ M].
assert (E : nh / dh + mh / dh - (qu + qv) = (w - (qu + qv)) + w * (t - 1) + (nh - ns) / dh + (mh - ms) / dh).
{ unfold t, w. field. split; [apply dh_not_0 | apply ds_not_0]. }
rewrite E. clear E.
apply Rle_trans with (1 := Rabs_triang _ _). unfold B_both.
apply Rplus_le_compat; [| exact M].
apply Rle_trans with (1 := Rabs_triang _ _).
apply Rplus_le_compat; [| exact N].
apply Rle_trans with (1 := Rabs_triang _ _).
apply Rplus_le_compat; [exact S |]. rewrite Rabs_mult.
pose proof of_tiny_pos. pose proof (Rabs_pos w). pose proof share_eps. pose proof eps_range.
destruct kd; simpl in *.
- assert (Rabs w * Rabs (t - 1) <= Rabs w * share) by (apply Rmult_le_compat_l; assumption). nra.
- assert (Z : Rabs (t - 1) = 0) by (pose proof (Rabs_pos (t - 1)); lra). rewrite Z. lra.
Qed.

(** What the computed u and v are off n^/d^ by: H(P), or R + H(P + R) by a reciprocal (lemmas below). *)
Variables (uh vh Ru Rv : R).
Hypothesis own_u : Rabs (uh - nh / dh) <= Ru.
Hypothesis own_v : Rabs (vh - mh / dh) <= Rv.
Definition B_sum := B_both + Ru + Rv.

Lemma sum_before : Rabs (uh + vh - (qu + qv)) <= B_sum.
Proof.
pose proof both_before as BB.
assert (E : uh + vh - (qu + qv) = (nh / dh + mh / dh - (qu + qv)) + (uh - nh / dh) + (vh - mh / dh)) by ring.
rewrite E. unfold B_sum.
apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat; [| exact own_v].
apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat; [exact BB | exact own_u].
Qed.

(** sum-of-quotients *)
Theorem sum_of_quotients e : Q + B_sum <= bpow radix2 e ->
  Rabs (fl (uh + vh) - (qu + qv)) <= B_sum + H e.
Proof.
intros He. pose proof sum_before as SB.
assert (SZ : Rabs (uh + vh) <= bpow radix2 e).
{ pose proof (Rabs_triang (qu + qv) (uh + vh - (qu + qv))) as T.
  replace (qu + qv + (uh + vh - (qu + qv))) with (uh + vh) in T by ring. lra. }
pose proof (fl_half_ulp p s Hp choice _ e SZ) as R.
pose proof (Rabs_triang (fl (uh + vh) - (uh + vh)) (uh + vh - (qu + qv))) as T.
replace (fl (uh + vh) - (uh + vh) + (uh + vh - (qu + qv))) with (fl (uh + vh) - (qu + qv)) in T by ring. lra.
Qed.

(** rest-of-quotients. [before_rest] is the hypothesis that a lemma "|fl(1-u^) - (1-u)| <= Er" alone does not give. *)
Variables (Sr Er : R) (er : Z).
Hypothesis size_rest : Rabs (1 - qu) <= Sr.
Hypothesis before_rest : Rabs ((1 - uh) - (1 - qu)) <= Er.
Hypothesis Her : Sr + Er <= bpow radix2 er.
Variable Sz : R.
Hypothesis size_own : Rabs (1 - (qu + qv)) <= Sz.
Definition B_rest := B_sum + H er.

Theorem rest_of_quotients e : Sz + B_rest <= bpow radix2 e ->
  Rabs (fl (fl (1 - uh) - vh) - (1 - qu - qv)) <= B_rest + H e.
Proof.
intros He. pose proof sum_before as SB.
assert (SZ : Rabs (1 - uh) <= bpow radix2 er).
{ pose proof (Rabs_triang (1 - qu) ((1 - uh) - (1 - qu))) as T.
  replace (1 - qu + ((1 - uh) - (1 - qu))) with (1 - uh) in T by ring. lra. }
pose proof (fl_half_ulp p s Hp choice _ er SZ) as R1.
set (r := fl (1 - uh)) in *.
assert (E : r - vh - (1 - qu - qv) = (r - (1 - uh)) + - (uh + vh - (qu + qv))) by ring.
assert (BB : Rabs (r - vh - (1 - qu - qv)) <= B_rest).
{ rewrite E. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. unfold B_rest. lra. }
assert (SB2 : Rabs (r - vh) <= bpow radix2 e).
{ pose proof (Rabs_triang (1 - (qu + qv)) (r - vh - (1 - qu - qv))) as T.
  replace (1 - (qu + qv) + (r - vh - (1 - qu - qv))) with (r - vh) in T by ring. lra. }
pose proof (fl_half_ulp p s Hp choice _ e SB2) as R2.
pose proof (Rabs_triang (fl (r - vh) - (r - vh)) (r - vh - (1 - qu - qv))) as T.
replace (fl (r - vh) - (r - vh) + (r - vh - (1 - qu - qv))) with (fl (r - vh) - (1 - qu - qv)) in T by ring. lra.
Qed.
End Two.

(** The roundings of u itself: divided, *)
Lemma divided k qx Qx Ex xs xh e : left_out k xs xh -> Rabs qx <= Qx -> Rabs (xh / dh - qx) <= Ex ->
  P Qx Ex <= bpow radix2 e -> Rabs (fl (xh / dh) - xh / dh) <= H e.
Proof.
intros Lk Sx Bx He. destruct (P_bounds k qx Qx Ex xs xh Lk Sx Bx) as [PX _].
apply fl_half_ulp; [exact Hp | lra].
Qed.
(** or multiplied by one rounded reciprocal. *)
Lemma multiplied k qx Qx Ex xs xh m e : left_out k xs xh -> Rabs qx <= Qx -> Rabs (xh / dh - qx) <= Ex ->
  Rabs xh <= m -> let r := u * P Qx Ex + tau * m in
  P Qx Ex + r <= bpow radix2 e -> Rabs (fl (xh * fl (1 / dh)) - xh / dh) <= r + H e.
Proof.
intros Lk Sx Bx M r He. destruct (P_bounds k qx Qx Ex xs xh Lk Sx Bx) as [PX _].
pose proof (fl_error p s Hp choice (1 / dh)) as E.
assert (R1 : Rabs (xh * fl (1 / dh) - xh / dh) <= r).
{ replace (xh * fl (1 / dh) - xh / dh) with (xh * (fl (1 / dh) - 1 / dh)) by (field; apply dh_not_0).
  rewrite Rabs_mult. apply Rle_trans with (Rabs xh * (u * Rabs (1 / dh) + tau)).
  { apply Rmult_le_compat_l; [apply Rabs_pos | exact E]. }
  replace (Rabs xh * (u * Rabs (1 / dh) + tau)) with (u * Rabs (xh / dh) + tau * Rabs xh).
  2: { unfold Rdiv. rewrite !Rabs_mult, Rabs_R1. ring. }
  apply Rplus_le_compat; apply Rmult_le_compat_l; try assumption; lra. }
set (x := xh * fl (1 / dh)) in *.
assert (X : Rabs x <= bpow radix2 e).
{ pose proof (Rabs_triang (xh / dh) (x - xh / dh)) as T. replace (xh / dh + (x - xh / dh)) with x in T by ring. lra. }
pose proof (fl_half_ulp p s Hp choice x e X) as R2.
pose proof (Rabs_triang (fl x - x) (x - xh / dh)) as T.
replace (fl x - x + (x - xh / dh)) with (fl x - xh / dh) in T by ring. lra.
Qed.
End Quotients.
