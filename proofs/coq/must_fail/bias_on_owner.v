(* False: the 1 is subtracted from edges that own their samples. Then no triangle has
   those of a shared edge. *)
Require Import ZArith Bool.
From Halfspace Require Import edge_function fill_rule.
Open Scope Z_scope.

Definition wrong_bias (own : Z -> Z -> bool) (a b : Z) : Z := if own a b then 1 else 0.

Theorem bias_on_owner : ~ forall own, fill_rule own -> forall e a b,
  (0 <=? e - wrong_bias own a b) = inside_of own e a b.
Proof. intro H; discriminate (H top_left top_left_is_a_rule 0 1 0). Qed.

Print Assumptions bias_on_owner.
