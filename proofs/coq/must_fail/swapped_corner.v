(* False: a tile is rejected at a corner where E is not largest. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function corner_tests.
Open Scope Z_scope.

Definition wrong_to_largest (dx dy size : Z) : Z := (Z.max dx 0 + Z.min dy 0) * (size - 1).

Theorem swapped_corner : ~ forall e dx dy size, 0 < size -> e + wrong_to_largest dx dy size < 0 ->
  forall x y, in_square size x y -> e + dx * x + dy * y < 0.
Proof.
  intro H; assert (0 <= -1 + 0 * 0 + 1 * 3) as Hinside by lia; apply (Zle_not_lt _ _ Hinside).
  apply (H (-1) 0 1 4); unfold in_square, wrong_to_largest; lia.
Qed.

Print Assumptions swapped_corner.
