(* False: Hi-Z may reject with an upper bound that is rounded to a step below. *)
Require Import ZArith Lia Bool.
From Halfspace Require Import hi_z.
Open Scope Z_scope.

(* To steps of 2 codes. *)
Definition rounded_inward (most : Z) : Z := most / 2 * 2.

Theorem inward_rounding : ~ forall incoming stored least most, least <= stored <= most ->
  test Less (fun code => code <=? incoming) (fun code => incoming <? code) least (rounded_inward most)
    true true = NonePasses ->
  passes Less incoming stored = false.
Proof.
  intro H; specialize (H 4 5 5 5 ltac:(lia)); simpl in H; unfold test, rounded_inward in H; simpl in H.
  now specialize (H eq_refl).
Qed.

Print Assumptions inward_rounding.
