(* False: a rule that partitions the samples of every edge also partitions those around a vertex. The rule
   here is the top-left rule, but for two directions turned round; the sample at the vertex itself is lost. *)
Require Import ZArith Lia Bool.
From Halfspace Require Import edge_function fill_rule triangle_cover.
Open Scope Z_scope.

Definition odd_rule (a b : Z) : bool :=
  if (b =? 0) && ((a =? 1) || (a =? -1)) then a =? -1 else top_left a b.

Lemma odd_rule_flips : flips odd_rule.
Proof.
  intros a b Hab; unfold odd_rule.
  replace (- b =? 0) with (b =? 0) by (apply eq_true_iff_eq; rewrite !Z.eqb_eq; lia).
  replace (- a =? 1) with (a =? -1) by (apply eq_true_iff_eq; rewrite !Z.eqb_eq; lia).
  replace (- a =? -1) with (a =? 1) by (apply eq_true_iff_eq; rewrite !Z.eqb_eq; lia).
  pose proof (proj1 top_left_is_a_rule a b Hab).
  destruct (b =? 0), (Z.eqb_spec a 1), (Z.eqb_spec a (-1)); simpl; try reflexivity; try assumption; lia.
Qed.

Theorem flips_alone : ~ forall own, flips own -> forall a b c d p,
  0 < edge a b d -> 0 < edge b c d -> 0 < edge c a d ->
  Z.b2z (covers own a b d p) + Z.b2z (covers own b c d p) + Z.b2z (covers own c a d p) =
  Z.b2z (covers own a b c p).
Proof.
  intro H; set (d := Point 0 0).
  specialize (H odd_rule odd_rule_flips (Point 0 (-1)) (Point 1 1) (Point (-1) 1) d d).
  now specialize (H eq_refl eq_refl eq_refl).
Qed.

Print Assumptions flips_alone.
