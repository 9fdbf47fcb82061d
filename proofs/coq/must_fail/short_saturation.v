(* False: values at the origin of a tile may be saturated to one bit less. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function corner_tests saturation.
Open Scope Z_scope.

Theorem short_saturation : ~ forall s t v a b x y, 4 <= s <= 8 -> 2 <= t <= 4 ->
  signed (step_bits s) a -> signed (step_bits s) b -> in_square (2 ^ t) x y ->
  (0 <= saturate (2 ^ t * 2 ^ (step_bits s - 1)) v + x * a + y * b <-> 0 <= v + x * a + y * b).
Proof.
  intro H; specialize (H 8 2 (6 * 2 ^ 24) (- 2 ^ 24) (- 2 ^ 24) 3 3).
  assert (Hsign : 0 <= 6 * 2 ^ 24 + 3 * - 2 ^ 24 + 3 * - 2 ^ 24) by lia.
  apply H in Hsign; unfold signed, step_bits, in_square in *; [unfold saturate in Hsign | ..];
    simpl in *; lia.
Qed.

Print Assumptions short_saturation.
