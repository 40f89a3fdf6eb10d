(** What the theorems suppose: the axioms of Coq's real numbers, and nothing else (assumptions.txt). *)
From Hairline Require Import Rounding Quotients Sum Opposite Verdict Reflect.
From HairlineClaims Require Import scalar_triple_edge.
Print Assumptions fl_half_ulp.
Print Assumptions fma_computes.
Print Assumptions quotient.
Print Assumptions quotient_by_reciprocal.
Print Assumptions sum_of_quotients.
Print Assumptions rest_of_quotients.
Print Assumptions sum_of_products.
Print Assumptions opposite.
Print Assumptions miss.
Print Assumptions hit_max.
Print Assumptions outside.
Print Assumptions check_program.
Print Assumptions edge.
