(* What Hi-Z knows of a triangle's codes in a tile, from its plane: words of all samples lie between corners
   of the tile, and a bound that is stored becomes the least word of that code.

   A unit is that of a word of 32 bits. Hi-Z keeps 16 bits below it, a gradient for a sub-pixel 22. Covered
   here: unorm surfaces. Depths within [0, 1] have short words, others long ones, with 32 bits more. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function corner_tests saturation widths.
Open Scope Z_scope.

(* nearest() of tile_plane() in model/halfspace/units/depth_plane.hpp, of a value with f bits more. *)
Definition nearest (value f : Z) : Z := Z.shiftr (value + 2 ^ (f - 1)) f.

(* The word of the interpolator at pixel (x, y) of a square that begins at pixel (ax, ay): short words, with
   the gradients gx and gy for a sub-pixel and z at the vertex (vx, vy). Polygon offset is a whole number of
   units, so z may have it in it. *)
Definition word_at (s z gx gy vx vy ax ay x y : Z) : Z :=
  nearest (z * 2 ^ 22 + gx * (ax * 2 ^ s + 2 ^ (s - 1) - vx) + gy * (ay * 2 ^ s + 2 ^ (s - 1) - vy)) 22 +
  (x - ax) * nearest gx (22 - s) + (y - ay) * nearest gy (22 - s).

(* step() and plane.z of hi_z_plane() in model/halfspace/units/hi_z_plane.hpp, and the plane at a pixel. A
   shift by a negative number is one to the left. *)
Definition step (s g : Z) : Z := Z.shiftr g (22 - 16 - s).
Definition plane_z (s z gx gy vx vy : Z) : Z :=
  z * 2 ^ 16 + Z.shiftr (step s gx * (2 ^ (s - 1) - vx) + step s gy * (2 ^ (s - 1) - vy)) s.
Definition plane_at (s z gx gy vx vy x y : Z) : Z :=
  plane_z s z gx gy vx vy + step s gx * x + step s gy * y.

(* kHiZMargin. *)
Definition margin : Z := 18.

(* Half a unit at most, each. *)
Lemma nearest_error : forall value f, 1 <= f ->
  - 2 ^ (f - 1) < nearest value f * 2 ^ f - value <= 2 ^ (f - 1).
Proof.
  intros value f Hf; unfold nearest; rewrite Z.shiftr_div_pow2 by lia.
  assert (Hhalf : 2 ^ f = 2 * 2 ^ (f - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  pose proof (Z.pow_pos_nonneg 2 (f - 1) ltac:(lia) ltac:(lia)).
  pose proof (Z.div_mod (value + 2 ^ (f - 1)) (2 ^ f) ltac:(lia)).
  pose proof (Z.mod_pos_bound (value + 2 ^ (f - 1)) (2 ^ f) ltac:(lia)).
  lia.
Qed.

(* The plane without any rounding, with 22 bits below the unit. *)
Definition exact_plane (s z gx gy vx vy x y : Z) : Z :=
  z * 2 ^ 22 + gx * (x * 2 ^ s + 2 ^ (s - 1) - vx) + gy * (y * 2 ^ s + 2 ^ (s - 1) - vy).

(* The interpolator is 15.5 units away from it at most. *)
Theorem interpolator_error : forall s z gx gy vx vy ax ay x y, 4 <= s <= 8 ->
  0 <= x - ax < 16 -> 0 <= y - ay < 16 ->
  Z.abs (word_at s z gx gy vx vy ax ay x y * 2 ^ 22 - exact_plane s z gx gy vx vy x y) <= 31 * 2 ^ 21.
Proof.
  intros s z gx gy vx vy ax ay x y Hs Hx Hy; unfold word_at, exact_plane.
  pose proof (nearest_error (z * 2 ^ 22 + gx * (ax * 2 ^ s + 2 ^ (s - 1) - vx) +
                             gy * (ay * 2 ^ s + 2 ^ (s - 1) - vy)) 22 ltac:(lia)) as H0.
  pose proof (nearest_error gx (22 - s) ltac:(lia)) as H1.
  pose proof (nearest_error gy (22 - s) ltac:(lia)) as H2.
  revert H0 H1 H2.
  generalize (nearest (z * 2 ^ 22 + gx * (ax * 2 ^ s + 2 ^ (s - 1) - vx) +
                       gy * (ay * 2 ^ s + 2 ^ (s - 1) - vy)) 22) (nearest gx (22 - s)) (nearest gy (22 - s)).
  intros w0 dx dy H0 H1 H2.
  assert (Hsplit : 2 ^ 22 = 2 ^ (22 - s) * 2 ^ s) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  assert (Hhalf : 2 ^ 21 = 2 ^ (22 - s - 1) * 2 ^ s) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  pose proof (Z.pow_pos_nonneg 2 s ltac:(lia) ltac:(lia)) as Hp.
  assert (E1 : Z.abs ((x - ax) * (dx * 2 ^ 22 - gx * 2 ^ s)) <= 15 * 2 ^ 21).
  { assert (Z.abs (dx * 2 ^ 22 - gx * 2 ^ s) <= 2 ^ 21) by (rewrite Hsplit, Hhalf; nia).
    rewrite Z.abs_mul; nia. }
  assert (E2 : Z.abs ((y - ay) * (dy * 2 ^ 22 - gy * 2 ^ s)) <= 15 * 2 ^ 21).
  { assert (Z.abs (dy * 2 ^ 22 - gy * 2 ^ s) <= 2 ^ 21) by (rewrite Hsplit, Hhalf; nia).
    rewrite Z.abs_mul; nia. }
  change (2 ^ (22 - 1)) with (2 ^ 21) in H0.
  match goal with |- Z.abs ?d <= _ => replace d with
    ((w0 * 2 ^ 22 -
      (z * 2 ^ 22 + gx * (ax * 2 ^ s + 2 ^ (s - 1) - vx) + gy * (ay * 2 ^ s + 2 ^ (s - 1) - vy))) +
     (x - ax) * (dx * 2 ^ 22 - gx * 2 ^ s) + (y - ay) * (dy * 2 ^ 22 - gy * 2 ^ s)) by ring end.
  lia.
Qed.

(* Steps that are cut lose less than a unit of 2^-16 for each pixel; those of s >= 6 lose nothing. *)
Lemma step_error : forall s g, 4 <= s <= 8 -> 0 <= g * 2 ^ s - step s g * 2 ^ 6 < 2 ^ 6.
Proof.
  intros s g Hs; unfold step.
  assert (E : s = 4 \/ s = 5 \/ s = 6 \/ s = 7 \/ s = 8) by lia.
  destruct E as [E | [E | [E | [E | E]]]]; subst s.
  - rewrite Z.shiftr_div_pow2 by lia; change (2 ^ (22 - 16 - 4)) with 4; change (2 ^ 4) with 16;
    change (2 ^ 6) with 64.
    pose proof (Z.div_mod g 4 ltac:(lia)); pose proof (Z.mod_pos_bound g 4 ltac:(lia)); lia.
  - rewrite Z.shiftr_div_pow2 by lia; change (2 ^ (22 - 16 - 5)) with 2; change (2 ^ 5) with 32;
    change (2 ^ 6) with 64.
    pose proof (Z.div_mod g 2 ltac:(lia)); pose proof (Z.mod_pos_bound g 2 ltac:(lia)); lia.
  - change (22 - 16 - 6) with 0; rewrite Z.shiftr_0_r; lia.
  - change (22 - 16 - 7) with (- (1)); rewrite Z.shiftr_opp_r, Z.shiftl_mul_pow2 by lia;
    change (2 ^ 1) with 2;
      change (2 ^ 7) with 128; change (2 ^ 6) with 64; lia.
  - change (22 - 16 - 8) with (- (2)); rewrite Z.shiftr_opp_r, Z.shiftl_mul_pow2 by lia;
    change (2 ^ 2) with 4;
      change (2 ^ 8) with 256; change (2 ^ 6) with 64; lia.
Qed.

(* Hi-Z's plane is 1.5 units and 2^-16 away from it at most, where no sample is more than 1.5 2^15 pixels
   away from the vertex in x or y. *)
Theorem plane_error : forall s z gx gy vx vy x y, 4 <= s <= 8 ->
  Z.abs (x * 2 ^ s + 2 ^ (s - 1) - vx) <= 3 * 2 ^ 14 * 2 ^ s ->
  Z.abs (y * 2 ^ s + 2 ^ (s - 1) - vy) <= 3 * 2 ^ 14 * 2 ^ s ->
  Z.abs (plane_at s z gx gy vx vy x y * 2 ^ 6 - exact_plane s z gx gy vx vy x y) < 3 * 2 ^ 21 + 2 ^ 6.
Proof.
  intros s z gx gy vx vy x y Hs Hx Hy; unfold plane_at, plane_z, exact_plane.
  pose proof (step_error s gx Hs) as Ex; pose proof (step_error s gy Hs) as Ey.
  revert Ex Ey; generalize (step s gx) (step s gy); intros dx dy Ex Ey.
  rewrite Z.shiftr_div_pow2 by lia.
  pose proof (Z.pow_pos_nonneg 2 s ltac:(lia) ltac:(lia)) as Hp.
  set (way := dx * (2 ^ (s - 1) - vx) + dy * (2 ^ (s - 1) - vy)).
  pose proof (Z.div_mod way (2 ^ s) ltac:(lia)) as Hdiv; pose proof (Z.mod_pos_bound way (2 ^ s) Hp) as Hmod.
  set (qx := x * 2 ^ s + 2 ^ (s - 1) - vx) in *; set (qy := y * 2 ^ s + 2 ^ (s - 1) - vy) in *.
  assert (Hscaled : 2 ^ s * ((z * 2 ^ 16 + way / 2 ^ s + dx * x + dy * y) * 2 ^ 6 -
                             (z * 2 ^ 22 + gx * qx + gy * qy)) =
                    - (gx * 2 ^ s - dx * 2 ^ 6) * qx - (gy * 2 ^ s - dy * 2 ^ 6) * qy -
                    (way mod 2 ^ s) * 2 ^ 6).
  { replace (2 ^ s * ((z * 2 ^ 16 + way / 2 ^ s + dx * x + dy * y) * 2 ^ 6 -
                      (z * 2 ^ 22 + gx * qx + gy * qy)))
      with (2 ^ s * (way / 2 ^ s) * 2 ^ 6 + 2 ^ s * ((dx * x + dy * y) * 2 ^ 6 - gx * qx - gy * qy)) by ring.
    replace (2 ^ s * (way / 2 ^ s)) with (way - way mod 2 ^ s) by lia.
    unfold way, qx, qy; ring. }
  revert Hscaled; generalize (gx * 2 ^ s - dx * 2 ^ 6) (gy * 2 ^ s - dy * 2 ^ 6) Ex Ey.
  generalize ((z * 2 ^ 16 + way / 2 ^ s + dx * x + dy * y) * 2 ^ 6 - (z * 2 ^ 22 + gx * qx + gy * qy)).
  intros d ex ey Hex Hey Hscaled.
  change (2 ^ 6) with 64 in *; change (2 ^ 14) with 16384 in *; change (2 ^ 21) with 2097152 in *.
  assert (Z.abs (ex * qx) <= 63 * (3 * 16384 * 2 ^ s)) by (rewrite Z.abs_mul; nia).
  assert (Z.abs (ey * qy) <= 63 * (3 * 16384 * 2 ^ s)) by (rewrite Z.abs_mul; nia).
  nia.
Qed.

(* Together they are nearer than the margin. *)
Theorem margin_is_enough : forall s z gx gy vx vy ax ay x y, 4 <= s <= 8 ->
  0 <= x - ax < 16 -> 0 <= y - ay < 16 ->
  Z.abs (x * 2 ^ s + 2 ^ (s - 1) - vx) <= 3 * 2 ^ 14 * 2 ^ s ->
  Z.abs (y * 2 ^ s + 2 ^ (s - 1) - vy) <= 3 * 2 ^ 14 * 2 ^ s ->
  Z.abs (word_at s z gx gy vx vy ax ay x y * 2 ^ 16 - plane_at s z gx gy vx vy x y) < margin * 2 ^ 16.
Proof.
  intros s z gx gy vx vy ax ay x y Hs Hx Hy Hfx Hfy.
  pose proof (interpolator_error s z gx gy vx vy ax ay x y Hs Hx Hy).
  pose proof (plane_error s z gx gy vx vy x y Hs Hfx Hfy).
  unfold margin; change (2 ^ 22) with 4194304 in *; change (2 ^ 21) with 2097152 in *;
    change (2 ^ 16) with 65536; change (2 ^ 6) with 64 in *; lia.
Qed.

(* And no sample is so far away. *)
Theorem samples_are_near : forall s x y v, 4 <= s -> 0 <= x < 16384 -> 0 <= y < 16384 -> on_guard_band s v ->
  Z.abs (x * 2 ^ s + 2 ^ (s - 1) - px v) <= 3 * 2 ^ 14 * 2 ^ s /\
  Z.abs (y * 2 ^ s + 2 ^ (s - 1) - py v) <= 3 * 2 ^ 14 * 2 ^ s.
Proof.
  intros s x y v Hs Hx Hy [Hvx Hvy]; unfold signed, coord_bits in Hvx, Hvy.
  replace (16 + s - 1) with (15 + s) in Hvx, Hvy by ring; rewrite Z.pow_add_r in Hvx, Hvy by lia.
  assert (Hhalf : 2 ^ s = 2 * 2 ^ (s - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  pose proof (Z.pow_pos_nonneg 2 (s - 1) ltac:(lia) ltac:(lia)).
  change (2 ^ 15) with 32768 in *; change (2 ^ 14) with 16384; rewrite Hhalf in *; split; nia.
Qed.

(* hi_z_wrap(): the low 50 bits as a signed number. *)
Definition wrap (v : Z) : Z := (v + 2 ^ 49) mod 2 ^ 50 - 2 ^ 49.

(* The walk from block to block is modulo 2^50, and that does no harm where the plane is in range. *)
Theorem wrap_is_modular : forall v k, - 2 ^ 49 <= v < 2 ^ 49 -> wrap (v + k * 2 ^ 50) = v.
Proof.
  intros v k Hv; unfold wrap.
  replace (v + k * 2 ^ 50 + 2 ^ 49) with (v + 2 ^ 49 + k * 2 ^ 50) by ring.
  rewrite Z.mod_add, Z.mod_small by lia; ring.
Qed.

(* tile_words(): `first` is the plane at the tile's first pixel, modulo 2^50. *)
Definition tile_least (first dx dy size : Z) : Z :=
  Z.shiftr (wrap (first + to_least dx dy size)) 16 - margin.
Definition tile_most (first dx dy size : Z) : Z :=
  Z.shiftr (wrap (first + to_largest dx dy size)) 16 + 1 + margin.

Lemma corner_distance : forall d most size x, size <= 16 -> Z.abs d <= most -> 0 <= x < size ->
  Z.abs (Z.min d 0 * (size - 1) - d * x) <= 15 * most /\ Z.abs (Z.max d 0 * (size - 1) - d * x) <= 15 * most.
Proof.
  intros d most size x Hsize Hd Hx.
  destruct (Z.le_gt_cases 0 d); [rewrite Z.min_r, Z.max_l by lia | rewrite Z.min_l, Z.max_r by lia];
    split; nia.
Qed.

(* Words of all samples of a tile lie between these, if it has one sample of the triangle at which the plane
   is that of a word: then no corner is beyond 2^49. `word` is in units of 2^-fine. *)
Theorem tile_words_are_bounds : forall first k dx dy size x y x' y' word fine, 0 < size <= 16 -> 0 <= fine ->
  - 2 ^ 41 <= dx < 2 ^ 41 -> - 2 ^ 41 <= dy < 2 ^ 41 -> in_square size x y -> in_square size x' y' ->
  Z.abs (first + dx * x' + dy * y') <= 2 ^ 48 ->
  Z.abs (word * 2 ^ 16 - (first + dx * x + dy * y) * 2 ^ fine) < margin * 2 ^ 16 * 2 ^ fine ->
  tile_least (first + k * 2 ^ 50) dx dy size * 2 ^ fine <= word <=
  tile_most (first + k * 2 ^ 50) dx dy size * 2 ^ fine.
Proof.
  intros first k dx dy size x y x' y' word fine Hsize Hfine Hdx Hdy Hxy Hxy' Hrange Hword.
  pose proof (least_is_a_bound dx dy size x y Hxy) as Hl.
  pose proof (largest_is_a_bound dx dy size x y Hxy) as Hm.
  assert (Hcorner : Z.abs (to_least dx dy size - (dx * x' + dy * y')) <= 30 * 2 ^ 41 /\
                    Z.abs (to_largest dx dy size - (dx * x' + dy * y')) <= 30 * 2 ^ 41).
  { destruct Hxy' as [Hx' Hy']; unfold to_least, to_largest.
    pose proof (corner_distance dx (2 ^ 41) size x' ltac:(lia) ltac:(lia) Hx').
    pose proof (corner_distance dy (2 ^ 41) size y' ltac:(lia) ltac:(lia) Hy').
    split; lia. }
  unfold tile_least, tile_most.
  replace (first + k * 2 ^ 50 + to_least dx dy size) with (first + to_least dx dy size + k * 2 ^ 50) by ring.
  replace (first + k * 2 ^ 50 + to_largest dx dy size) with (first + to_largest dx dy size + k * 2 ^ 50)
    by ring.
  rewrite !wrap_is_modular by lia.
  rewrite !Z.shiftr_div_pow2 by lia.
  pose proof (Z.pow_pos_nonneg 2 fine ltac:(lia) Hfine) as Hp.
  pose proof (Z.div_mod (first + to_least dx dy size) (2 ^ 16) ltac:(lia)).
  pose proof (Z.mod_pos_bound (first + to_least dx dy size) (2 ^ 16) ltac:(lia)).
  pose proof (Z.div_mod (first + to_largest dx dy size) (2 ^ 16) ltac:(lia)).
  pose proof (Z.mod_pos_bound (first + to_largest dx dy size) (2 ^ 16) ltac:(lia)).
  revert Hword; generalize dependent (2 ^ fine); intros p Hp Hword.
  set (ql := (first + to_least dx dy size) / 2 ^ 16) in *.
  set (qm := (first + to_largest dx dy size) / 2 ^ 16) in *.
  unfold margin in *; change (2 ^ 16) with 65536 in *.
  assert (ql * 65536 * p <= (first + dx * x + dy * y) * p) by (apply Z.mul_le_mono_nonneg_r; lia).
  assert ((first + dx * x + dy * y) * p <= (qm + 1) * 65536 * p) by (apply Z.mul_le_mono_nonneg_r; lia).
  split; lia.
Qed.

(* The same for the words of the interpolator: of a tile at pixel (tx, ty) in the square of 16 pixels at (ax,
   ay), of which hi_z has the plane at the tile's first pixel modulo 2^50. *)
Theorem tile_words_bound_the_interpolator : forall s z gx gy v ax ay tx ty size k x y x' y',
  let dx := step s gx in let dy := step s gy in
  let plane x y := plane_at s z gx gy (px v) (py v) x y in
  4 <= s <= 8 -> 0 < size <= 16 -> on_guard_band s v ->
  - 2 ^ 41 <= dx < 2 ^ 41 -> - 2 ^ 41 <= dy < 2 ^ 41 ->
  0 <= tx < 16384 - size -> 0 <= ty < 16384 - size ->
  0 <= tx - ax -> tx + size - ax <= 16 -> 0 <= ty - ay -> ty + size - ay <= 16 ->
  in_square size x y -> in_square size x' y' -> Z.abs (plane (tx + x') (ty + y')) <= 2 ^ 48 ->
  tile_least (plane tx ty + k * 2 ^ 50) dx dy size <=
  word_at s z gx gy (px v) (py v) ax ay (tx + x) (ty + y) <=
  tile_most (plane tx ty + k * 2 ^ 50) dx dy size.
Proof.
  intros s z gx gy v ax ay tx ty size k x y x' y' dx dy plane Hs Hsize Hv Hdx Hdy Htx Hty H1 H2 H3 H4
    Hxy Hxy' Hrange.
  assert (Hplane : forall x y, plane (tx + x) (ty + y) = plane tx ty + dx * x + dy * y).
  { intros; unfold plane, plane_at, dx, dy; ring. }
  destruct Hxy as [Hx Hy] eqn:Exy; clear Exy.
  destruct (samples_are_near s (tx + x) (ty + y) v ltac:(lia) ltac:(lia) ltac:(lia) Hv) as [Hnx Hny].
  pose proof (margin_is_enough s z gx gy (px v) (py v) ax ay (tx + x) (ty + y) Hs ltac:(lia) ltac:(lia)
    Hnx Hny) as Hmargin; fold (plane (tx + x) (ty + y)) in Hmargin.
  rewrite Hplane in Hmargin, Hrange.
  pose proof (tile_words_are_bounds (plane tx ty) k dx dy size x y x' y'
    (word_at s z gx gy (px v) (py v) ax ay (tx + x) (ty + y)) 0 Hsize ltac:(lia) Hdx Hdy (conj Hx Hy) Hxy'
    Hrange) as Hbounds.
  rewrite !Z.pow_0_r, !Z.mul_1_r in Hbounds; apply Hbounds; exact Hmargin.
Qed.

(* The code that z_test() makes of a word with `fine` bits below the unit, offset added, where 1 is 2^(31 -
   exponent) units: fraction is vertex_depth_fraction(). Then the clamp. *)
Definition code_of_word (fraction exponent fine lo hi word : Z) : Z :=
  let f := fraction + fine - exponent in
  Z.max lo (Z.min (Z.shiftr (word + 2 ^ (f - 1)) f) hi).

(* word_of_code() for unorm formats: scaled by 2^-exponent, rounded up. *)
Definition word_of_code (fraction exponent code : Z) : Z :=
  let value := code * 2 ^ fraction - 2 ^ (fraction - 1) in
  Z.shiftr (value + (2 ^ exponent - 1)) exponent.

(* CodeRange of model/halfspace/units/hi_z.cpp. `known`: the plane is. *)
Definition at_least_known (fraction exponent lo hi tile_least : Z) (known : bool) (code : Z) : bool :=
  (code <=? lo) || (known && (code <=? hi) && (word_of_code fraction exponent code <=? tile_least)).
Definition below_known (fraction exponent lo hi tile_most : Z) (known : bool) (code : Z) : bool :=
  (hi <? code) || (known && (lo <? code) && (tile_most <? word_of_code fraction exponent code)).

Lemma word_of_code_is_least : forall fraction exponent fine code word unit_, 0 <= exponent -> 0 < fraction ->
  0 < fraction + fine - exponent -> 0 <= fine ->
  let f := fraction + fine - exponent in
  (word_of_code fraction exponent code <= unit_ -> unit_ * 2 ^ fine <= word ->
    code <= Z.shiftr (word + 2 ^ (f - 1)) f) /\
  (unit_ < word_of_code fraction exponent code -> word <= unit_ * 2 ^ fine ->
    Z.shiftr (word + 2 ^ (f - 1)) f < code).
Proof.
  intros fraction exponent fine code word u He Hfr Hf0 Hfine f; unfold word_of_code.
  rewrite !Z.shiftr_div_pow2 by lia.
  assert (Hhalf : 2 ^ f = 2 * 2 ^ (f - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  assert (Hscale : 2 ^ (f - 1) * 2 ^ exponent = 2 ^ (fraction - 1) * 2 ^ fine).
  { rewrite <- !Z.pow_add_r by lia; f_equal; unfold f; lia. }
  assert (Hfrac : 2 ^ fraction = 2 * 2 ^ (fraction - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  rewrite Hhalf, Hfrac.
  pose proof (Z.pow_pos_nonneg 2 (f - 1) ltac:(lia) ltac:(lia)) as Hp1.
  pose proof (Z.pow_pos_nonneg 2 exponent ltac:(lia) He) as Hp2.
  pose proof (Z.pow_pos_nonneg 2 (fraction - 1) ltac:(lia) ltac:(lia)) as Hp3.
  pose proof (Z.pow_pos_nonneg 2 fine ltac:(lia) Hfine) as Hp4.
  revert Hscale Hp1 Hp2 Hp3 Hp4; clear.
  generalize (2 ^ (f - 1)) (2 ^ exponent) (2 ^ (fraction - 1)) (2 ^ fine); intros h e r p Hscale Hh He Hr Hp.
  pose proof (Z.div_mod (code * (2 * r) - r + (e - 1)) e ltac:(lia)).
  pose proof (Z.mod_pos_bound (code * (2 * r) - r + (e - 1)) e He).
  set (q := (code * (2 * r) - r + (e - 1)) / e) in *.
  assert (E : (2 * code - 1) * h * e = (2 * code - 1) * r * p).
  { transitivity ((2 * code - 1) * (h * e)); [ring | rewrite Hscale; ring]. }
  split; intros Hu Hw.
  - assert (Hk : (2 * code - 1) * r <= u * e) by nia.
    apply Z.div_le_lower_bound; [lia |].
    assert (Hword : (2 * code - 1) * h * e <= word * e) by (rewrite E; nia).
    apply Z.mul_le_mono_pos_r in Hword; lia.
  - assert (Hk : u * e < (2 * code - 1) * r) by nia.
    apply Z.div_lt_upper_bound; [lia |].
    assert (Hword : word * e < (2 * code - 1) * h * e) by (rewrite E; nia).
    apply Z.mul_lt_mono_pos_r in Hword; lia.
Qed.

(* What CodeRange says it knows holds for the codes of all words between the bounds of the tile. *)
Theorem code_range_is_sound : forall fraction exponent fine lo hi known l m word code,
  0 <= exponent -> 0 < fraction -> 0 < fraction + fine - exponent -> 0 <= fine -> lo <= hi ->
  (known = true -> l * 2 ^ fine <= word <= m * 2 ^ fine) ->
  (at_least_known fraction exponent lo hi l known code = true ->
     code <= code_of_word fraction exponent fine lo hi word) /\
  (below_known fraction exponent lo hi m known code = true ->
     code_of_word fraction exponent fine lo hi word < code).
Proof.
  intros fraction exponent fine lo hi known l m word code He Hfr Hf Hfine Hlohi Hword.
  unfold at_least_known, below_known, code_of_word; split; intro H; apply Bool.orb_true_iff in H;
    destruct H as [H | H].
  - apply Z.leb_le in H; lia.
  - apply Bool.andb_true_iff in H; destruct H as [H Hw]; apply Bool.andb_true_iff in H;
    destruct H as [Hk Hc].
    apply Z.leb_le in Hw; apply Z.leb_le in Hc; specialize (Hword Hk).
    pose proof (proj1 (word_of_code_is_least fraction exponent fine code word l He Hfr Hf Hfine) Hw
      (proj1 Hword)).
    lia.
  - apply Z.ltb_lt in H; lia.
  - apply Bool.andb_true_iff in H; destruct H as [H Hw]; apply Bool.andb_true_iff in H;
    destruct H as [Hk Hc].
    apply Z.ltb_lt in Hw; apply Z.ltb_lt in Hc; specialize (Hword Hk).
    pose proof (proj2 (word_of_code_is_least fraction exponent fine code word m He Hfr Hf Hfine) Hw
      (proj2 Hword)).
    lia.
Qed.

Print Assumptions interpolator_error.
Print Assumptions plane_error.
Print Assumptions margin_is_enough.
Print Assumptions samples_are_near.
Print Assumptions wrap_is_modular.
Print Assumptions tile_words_are_bounds.
Print Assumptions tile_words_bound_the_interpolator.
Print Assumptions code_range_is_sound.
