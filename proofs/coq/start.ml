(* Before the lemmas that lemmas.py writes: what is asked of the extracted checker. *)
open Checker

let rec positive n =
  if n = 1 then XH else if n land 1 = 1 then XI (positive (n lsr 1)) else XO (positive (n lsr 1))

let integer n = if n = 0 then Z0 else if n > 0 then Zpos (positive n) else Zneg (positive (-n))
let binary mantissa exponent = dy (integer mantissa) (integer exponent)
let accepted = ref 0
let changed = ref 0
let failures = ref 0

(* A number with the last digit one less. *)
let less number = { number with fnum = Z.pred number.fnum }

(* Of how many variables a lemma is also changed: each one more takes twice as long. *)
let few = 9

(* A lemma is accepted, and refused with a smaller error or a smaller sum of higher order. *)
let lemma name make =
  let whole = make () in
  let said what = incr failures; Printf.printf "%s: %s\n%!" name what in
  if check whole then incr accepted else said "refused";
  if List.length whole.ends <= few then begin
    changed := !changed + 2;
    if check { whole with error = less whole.error } then said "accepted with a smaller error";
    if check { whole with rest = less whole.rest } then said "accepted with a smaller rest"
  end

let finish () =
  Printf.printf "%d lemmas accepted, %d changed ones tried, %d wrong answers\n" !accepted !changed !failures;
  if !failures > 0 || !accepted = 0 || !changed = 0 then exit 1
