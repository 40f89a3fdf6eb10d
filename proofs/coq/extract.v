(** The checker of Reflect.v as a program. *)
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlNatInt ZArith.
From Hairline Require Import Reflect.
Extraction Language OCaml.
Extraction "checker.ml" check dy Z.pred.
