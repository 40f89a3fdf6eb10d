(** The bound that corpora/proofs/scalar-triple-f32.proof claims of the kernel's edges, in words of the program: ties to even,
    every number rounded to 24 digits, differences of points at most 1023/1024. claims/scalar_triple.v is made by lemmas.py. *)
From Coq Require Import ZArith Reals List Lia Lra.
From Flocq Require Import Core.
From Hairline Require Import Rounding Sum Reflect.
From HairlineClaims Require Import scalar_triple.
Open Scope R_scope.
Notation f := (fl 24 (-149) (fun n => negb (Z.even n))).
Notation m := (1023 / 1024).
(** op 31, with inputs o, d, b, c (a is not in it). *)
Theorem edge : forall ox oy oz dx dy dz bx by_ bz cx cy cz : R,
  Rabs (cz - oz) <= m -> Rabs (cy - oy) <= m -> Rabs (cx - ox) <= m ->
  Rabs (bz - oz) <= m -> Rabs (by_ - oy) <= m -> Rabs (bx - ox) <= m ->
  Rabs dx <= 1 -> Rabs dy <= 1 -> Rabs dz <= 1 ->
  let cz' := f (cz - oz) in let cy' := f (cy - oy) in let cx' := f (cx - ox) in
  let bz' := f (bz - oz) in let by' := f (by_ - oy) in let bx' := f (bx - ox) in
  Rabs (f (f (f (f (f (dy * cz') - f (cy' * dz)) * bx') + f (f (f (dz * cx') - f (cz' * dx)) * by'))
         + f (f (f (dx * cy') - f (cx' * dy)) * bz'))
     - ((dy * (cz - oz) - (cy - oy) * dz) * (bx - ox) + (dz * (cx - ox) - (cz - oz) * dx) * (by_ - oy)
         + (dx * (cy - oy) - (cx - ox) * dy) * (bz - oz)))
  <= 8907777 / 8796093022208.
Proof.
intros.
set (v := fun i => match i with 0%nat => dy | 1%nat => cz - oz | 2%nat => cy - oy | 3%nat => dz | 4%nat => bx - ox | 5%nat => cx - ox
  | 6%nat => dx | 7%nat => by_ - oy | 8%nat => bz - oz | _ => 0 end).
pose proof (check_program the (fun n => negb (Z.even n)) holds v) as P.
assert (A : forall x y, Rabs x <= y -> - y <= x <= y).
{ intros x y. unfold Rabs. destruct Rcase_abs; lra. }
assert (B : forall i, (i < vars the)%nat ->
  F2R (fst (nth i (ends the) (zero, zero))) <= v i <= F2R (snd (nth i (ends the) (zero, zero)))).
{ intros i I. change (vars the) with 9%nat in I.
  do 9 (destruct i as [| i]; [unfold F2R; simpl; match goal with |- _ <= ?x <= _ => 
     match goal with H : Rabs x <= _ |- _ => pose proof (A _ _ H) end end; lra |]). lia. }
assert (O : forall i, (vars the <= i)%nat -> v i = 0).
{ intros i I. change (vars the) with 9%nat in I. do 9 (destruct i as [| i]; [lia |]). reflexivity. }
specialize (P B O).
replace (8907777 / 8796093022208) with (F2R (error the)) by (unfold F2R; simpl; lra).
exact P.
Qed.
