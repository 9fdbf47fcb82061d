(* Widths of edges: no value needs more bits than model/halfspace/numerics/widths.hpp gives it. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function fill_rule sub_pixel saturation.
Open Scope Z_scope.

(* CoordBits, EdgeBits and PixelEdgeBits; StepBits and LocalEdgeBits are in saturation.v. *)
Definition coord_bits (s : Z) : Z := 16 + s.
Definition edge_bits (s : Z) : Z := 2 * coord_bits s + 3.
Definition pixel_edge_bits (s : Z) : Z := edge_bits s - s.

Definition on_guard_band (s : Z) (p : point) : Prop :=
  signed (coord_bits s) (px p) /\ signed (coord_bits s) (py p).

Theorem steps_fit : forall s i j, 0 <= s -> on_guard_band s i -> on_guard_band s j ->
  signed (step_bits s) (step_a i j) /\ signed (step_bits s) (step_b i j).
Proof.
  unfold on_guard_band, signed, coord_bits, step_bits, step_a, step_b; intros s i j Hs [Hix Hiy] [Hjx Hjy].
  replace (16 + s + 1 - 1) with (Z.succ (16 + s - 1)) by ring.
  rewrite Z.pow_succ_r by lia; lia.
Qed.

(* Twice the area of a triangle in a square of side d is d^2 at most: a bound of products of differences. *)
Lemma area_in_square : forall d u v p q,
  Z.abs u <= d -> Z.abs v <= d -> Z.abs (u - v) <= d ->
  Z.abs p <= d -> Z.abs q <= d -> Z.abs (p - q) <= d ->
  Z.abs (u * p - v * q) <= d * d.
Proof.
  assert (Hpositive : forall d u v p q, 0 <= u <= d -> 0 <= v <= d ->
    Z.abs p <= d -> Z.abs q <= d -> Z.abs (p - q) <= d -> Z.abs (u * p - v * q) <= d * d).
  { intros d u v p q Hu Hv Hp Hq Hpq.
    destruct (Z.le_gt_cases 0 p), (Z.le_gt_cases 0 q).
    - assert (0 <= u * p <= d * d) by nia; assert (0 <= v * q <= d * d) by nia; lia.
    - assert (0 <= u * p <= d * p) by nia; assert (0 <= v * - q <= d * - q) by nia; nia.
    - assert (0 <= u * - p <= d * - p) by nia; assert (0 <= v * q <= d * q) by nia; nia.
    - assert (0 <= u * - p <= d * d) by nia; assert (0 <= v * - q <= d * d) by nia; lia. }
  intros d u v p q Hu Hv Huv Hp Hq Hpq.
  destruct (Z.le_gt_cases 0 u), (Z.le_gt_cases 0 v).
  - apply Hpositive; lia.
  - assert (Z.abs (u * p) <= u * d) by (rewrite Z.abs_mul; nia).
    assert (Z.abs (v * q) <= - v * d) by (rewrite Z.abs_mul; nia); nia.
  - assert (Z.abs (u * p) <= - u * d) by (rewrite Z.abs_mul; nia).
    assert (Z.abs (v * q) <= v * d) by (rewrite Z.abs_mul; nia); nia.
  - replace (u * p - v * q) with (- u * - p - - v * - q) by ring; apply Hpositive; lia.
Qed.

Lemma edge_bound : forall s i j p, 0 <= s -> on_guard_band s i -> on_guard_band s j -> on_guard_band s p ->
  Z.abs (edge i j p) <= (2 ^ coord_bits s - 1) * (2 ^ coord_bits s - 1).
Proof.
  unfold on_guard_band, signed; intros s i j p Hs [Hix Hiy] [Hjx Hjy] [Hpx Hpy].
  replace (2 ^ coord_bits s) with (2 * 2 ^ (coord_bits s - 1))
    by (rewrite <- Z.pow_succ_r by (unfold coord_bits; lia); f_equal; lia).
  rewrite edge_is_cross_product; unfold twice_area.
  apply area_in_square; lia.
Qed.

(* Two bits less than EdgeBits would do, with the bias too, and no fewer. *)
Theorem edge_fits_closely : forall own s i j p, 0 <= s ->
  on_guard_band s i -> on_guard_band s j -> on_guard_band s p ->
  signed (2 * coord_bits s + 1) (edge i j p) /\
  signed (2 * coord_bits s + 1) (edge i j p - bias own (step_a i j) (step_b i j)).
Proof.
  intros own s i j p Hs Hi Hj Hp; pose proof (edge_bound s i j p Hs Hi Hj Hp) as H.
  assert (Hb : 0 <= bias own (step_a i j) (step_b i j) <= 1).
  { unfold bias; destruct (own (step_a i j) (step_b i j)); lia. }
  unfold signed; replace (2 * coord_bits s + 1 - 1) with (coord_bits s + coord_bits s) by ring.
  rewrite Z.pow_add_r by (unfold coord_bits; lia).
  assert (0 < 2 ^ coord_bits s) by (apply Z.pow_pos_nonneg; unfold coord_bits; lia).
  nia.
Qed.

Theorem edge_needs_these_bits : forall s, 0 <= s -> exists i j p,
  on_guard_band s i /\ on_guard_band s j /\ on_guard_band s p /\
  edge i j p = (2 ^ coord_bits s - 1) * (2 ^ coord_bits s - 1) /\ ~ signed (2 * coord_bits s) (edge i j p).
Proof.
  intros s Hs; remember (2 ^ (coord_bits s - 1)) as h eqn:Eh.
  assert (Hh : 2 < h).
  { rewrite Eh; unfold coord_bits; replace 2 with (2 ^ 1) at 1 by reflexivity; apply Z.pow_lt_mono_r; lia. }
  assert (Hc : 2 ^ coord_bits s = 2 * h).
  { rewrite Eh, <- Z.pow_succ_r by (unfold coord_bits; lia); f_equal; lia. }
  exists (Point (- h) (- h)), (Point (h - 1) (- h)), (Point (- h) (h - 1)).
  assert (He : edge (Point (- h) (- h)) (Point (h - 1) (- h)) (Point (- h) (h - 1)) =
               (2 ^ coord_bits s - 1) * (2 ^ coord_bits s - 1)).
  { rewrite Hc; unfold edge, step_a, step_b; cbn [px py]; ring. }
  unfold on_guard_band, signed; rewrite <- Eh; cbn [px py].
  split; [lia |]; split; [lia |]; split; [lia |]; split; [exact He |].
  rewrite He; replace (2 * coord_bits s - 1) with (coord_bits s + (coord_bits s - 1)) by ring.
  rewrite Z.pow_add_r by (unfold coord_bits; lia); rewrite <- Eh, Hc; nia.
Qed.

Lemma signed_widens : forall n m v, 1 <= n -> n <= m -> signed n v -> signed m v.
Proof.
  unfold signed; intros n m v Hn Hnm Hv.
  assert (2 ^ (n - 1) <= 2 ^ (m - 1)) by (apply Z.pow_le_mono_r; lia); lia.
Qed.

Theorem edge_fits : forall own s i j p, 0 <= s ->
  on_guard_band s i -> on_guard_band s j -> on_guard_band s p ->
  signed (edge_bits s) (edge i j p) /\
  signed (edge_bits s) (edge i j p - bias own (step_a i j) (step_b i j)).
Proof.
  intros own s i j p Hs Hi Hj Hp; destruct (edge_fits_closely own s i j p Hs Hi Hj Hp).
  split; apply signed_widens with (2 * coord_bits s + 1); unfold edge_bits, coord_bits in *; trivial; lia.
Qed.

Theorem pixel_edge_fits : forall s e, 0 <= s ->
  signed (edge_bits s) e -> signed (pixel_edge_bits s) (drop_sub_pixel s e).
Proof.
  unfold signed, pixel_edge_bits, drop_sub_pixel; intros s e Hs He.
  rewrite Z.shiftr_div_pow2 by exact Hs.
  replace (edge_bits s - 1) with (edge_bits s - s - 1 + s) in He by ring.
  rewrite Z.pow_add_r in He by (unfold edge_bits, coord_bits; lia).
  pose proof (Z.pow_pos_nonneg 2 s ltac:(lia) Hs).
  split; [apply Z.div_le_lower_bound | apply Z.div_lt_upper_bound]; lia.
Qed.

(* Pixel centres of a screen of at most 16384 pixels are on the guard band. *)
Theorem screen_is_on_guard_band : forall s x y, 1 <= s -> 0 <= x < 16384 -> 0 <= y < 16384 ->
  on_guard_band s (pixel_centre s x y).
Proof.
  intros s x y Hs Hx Hy; unfold on_guard_band, pixel_centre, signed, coord_bits; simpl px; simpl py.
  replace (16 + s - 1) with (15 + s) by ring; rewrite Z.pow_add_r by lia.
  assert (Hhalf : 2 ^ s = 2 * 2 ^ (s - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  pose proof (Z.pow_pos_nonneg 2 (s - 1) ltac:(lia) ltac:(lia)).
  change (2 ^ 15) with 32768; rewrite Hhalf; split; nia.
Qed.

Print Assumptions steps_fit.
Print Assumptions edge_fits_closely.
Print Assumptions edge_needs_these_bits.
Print Assumptions edge_fits.
Print Assumptions pixel_edge_fits.
Print Assumptions screen_is_on_guard_band.
