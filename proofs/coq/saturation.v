(* Saturation of an edge value at the origin of a tile keeps the sign of the edge at all its samples. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function sub_pixel corner_tests.
Open Scope Z_scope.

(* saturate_local_edge() of model/halfspace/numerics/edge.hpp with kLimit = limit - 1, and what
   rtl/edge_saturate.sv cuts off to. *)
Definition saturate (limit v : Z) : Z := Z.max (- limit) (Z.min v (limit - 1)).

Theorem saturation_keeps_signs : forall limit most size v a b x y,
  in_square size x y -> Z.abs a + Z.abs b <= most -> (size - 1) * most < limit ->
  (0 <= saturate limit v + x * a + y * b <-> 0 <= v + x * a + y * b).
Proof.
  intros limit most size v a b x y [Hx Hy] Hab Hlimit; unfold saturate.
  assert (H : Z.abs (x * a + y * b) <= (size - 1) * most).
  { assert (Z.abs (x * a) <= (size - 1) * Z.abs a) by (rewrite Z.abs_mul; nia).
    assert (Z.abs (y * b) <= (size - 1) * Z.abs b) by (rewrite Z.abs_mul; nia).
    nia. }
  lia.
Qed.

(* No smaller limit serves steps of that size: where a and b add up to `most` in one direction, a limit that
   the steps across the tile reach turns a sign. *)
Theorem saturation_limit_is_least : forall limit most size,
  1 < size -> 0 < most -> 0 < limit -> limit <= (size - 1) * most ->
  exists v x y, in_square size x y /\
    ~ (0 <= saturate limit v + x * - most + y * 0 <-> 0 <= v + x * - most + y * 0).
Proof.
  intros limit most size Hsize Hmost Hl Hlimit.
  exists ((size - 1) * most), (size - 1), 0; unfold in_square, saturate; split; [lia |].
  intros [_ H]; lia.
Qed.

(* StepBits and LocalEdgeBits of model/halfspace/numerics/widths.hpp. *)
Definition signed (bits v : Z) : Prop := - 2 ^ (bits - 1) <= v < 2 ^ (bits - 1).
Definition step_bits (s : Z) : Z := 16 + s + 1.
Definition local_edge_bits (s t : Z) : Z := step_bits s + t + 2.

Lemma steps_across : forall s a b, 0 <= s -> signed (step_bits s) a -> signed (step_bits s) b ->
  Z.abs a + Z.abs b <= 2 ^ step_bits s.
Proof.
  unfold signed, step_bits; intros s a b Hs Ha Hb.
  replace (16 + s + 1 - 1) with (16 + s) in * by ring.
  replace (2 ^ (16 + s + 1)) with (2 * 2 ^ (16 + s)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  lia.
Qed.

(* A limit of T 2^(17 + s) or more will do for a tile of T = 2^t pixels, so that of s = 8 serves every s. *)
Theorem limit_of_the_widths : forall s t limit v a b x y, 0 <= s -> 0 <= t ->
  2 ^ t * 2 ^ step_bits s <= limit ->
  signed (step_bits s) a -> signed (step_bits s) b -> in_square (2 ^ t) x y ->
  (0 <= saturate limit v + x * a + y * b <-> 0 <= v + x * a + y * b).
Proof.
  intros s t limit v a b x y Hs Ht Hlimit Ha Hb Hxy.
  apply saturation_keeps_signs with (most := 2 ^ step_bits s) (size := 2 ^ t); trivial.
  - now apply steps_across.
  - assert (0 < 2 ^ step_bits s) by (apply Z.pow_pos_nonneg; unfold step_bits; lia); nia.
Qed.

(* local_edge_limit() takes s = 8 for every s. *)
Theorem limit_of_the_model : forall s t v a b x y, 4 <= s <= 8 -> 0 <= t ->
  signed (step_bits s) a -> signed (step_bits s) b -> in_square (2 ^ t) x y ->
  (0 <= saturate (2 ^ t * 2 ^ step_bits 8) v + x * a + y * b <-> 0 <= v + x * a + y * b).
Proof.
  intros s t v a b x y Hs Ht; apply limit_of_the_widths; try lia.
  apply Z.mul_le_mono_nonneg_l; [apply Z.pow_nonneg; lia |].
  apply Z.pow_le_mono_r; unfold step_bits; lia.
Qed.

(* The sums of rtl/edge_signs.sv do not overflow. *)
Theorem local_sums_fit : forall s t v a b x y, 0 <= s -> 0 <= t ->
  signed (step_bits s) a -> signed (step_bits s) b -> in_square (2 ^ t) x y ->
  signed (local_edge_bits s t) (saturate (2 ^ t * 2 ^ step_bits s) v + x * a + y * b).
Proof.
  intros s t v a b x y Hs Ht Ha Hb [Hx Hy].
  pose proof (steps_across s a b Hs Ha Hb) as Hab.
  assert (Hpos : 0 < 2 ^ step_bits s) by (apply Z.pow_pos_nonneg; unfold step_bits; lia).
  assert (Hsum : Z.abs (x * a + y * b) <= (2 ^ t - 1) * 2 ^ step_bits s).
  { assert (Z.abs (x * a) <= (2 ^ t - 1) * Z.abs a) by (rewrite Z.abs_mul; nia).
    assert (Z.abs (y * b) <= (2 ^ t - 1) * Z.abs b) by (rewrite Z.abs_mul; nia).
    nia. }
  assert (Hwidth : 2 ^ (local_edge_bits s t - 1) = 2 * (2 ^ t * 2 ^ step_bits s)).
  { rewrite <- Z.pow_add_r by (unfold step_bits; lia).
    replace (local_edge_bits s t - 1) with (Z.succ (t + step_bits s)) by (unfold local_edge_bits; lia).
    apply Z.pow_succ_r; unfold step_bits; lia. }
  unfold signed, saturate; rewrite Hwidth; nia.
Qed.

Print Assumptions saturation_keeps_signs.
Print Assumptions saturation_limit_is_least.
Print Assumptions limit_of_the_widths.
Print Assumptions limit_of_the_model.
Print Assumptions local_sums_fit.
