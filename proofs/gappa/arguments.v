(* What the Gappa theorems leave out: words modulo a power of two, the clamp to the codes of the vertices, two
   cuts in a row. *)
From Coq Require Import ZArith Lia Reals Lra.

Section Words.
Open Scope Z_scope.

(* model/halfspace/units/z_test.cpp: a sum cut to a whole number, plus an offset, cut to a code. *)
Lemma nested_cuts : forall n k offset m, 0 < k -> 0 < m ->
  (n / k + offset) / m = (n + offset * k) / (k * m).
Proof.
  intros n k offset m Hk Hm.
  rewrite <- Z.div_add by lia.
  rewrite Z.div_div by lia.
  reflexivity.
Qed.

Lemma divide_pow : forall a b, 0 <= a <= b -> (2 ^ a | 2 ^ b).
Proof.
  intros a b H. exists (2 ^ (b - a)).
  rewrite <- Z.pow_add_r by lia. f_equal. lia.
Qed.

(* model/halfspace/units/depth_plane.hpp, `nearest`: the low bits of a product are enough for the word's. *)
Lemma nearest_of_low_bits : forall value half bits fraction word,
  0 <= fraction -> 0 <= word -> fraction + word <= bits ->
  ((value mod 2 ^ bits + half) mod 2 ^ bits / 2 ^ fraction) mod 2 ^ word
  = ((value + half) / 2 ^ fraction) mod 2 ^ word.
Proof.
  intros value half bits fraction word Hf Hw Hb.
  rewrite Zplus_mod_idemp_l.
  set (x := value + half).
  assert (Hx : x = x mod 2 ^ bits + (x / 2 ^ bits * 2 ^ (bits - fraction)) * 2 ^ fraction).
  { rewrite <- Z.mul_assoc, <- Z.pow_add_r by lia.
    replace (bits - fraction + fraction) with bits by lia.
    pose proof (Z.div_mod x (2 ^ bits)). lia. }
  rewrite Hx at 2.
  rewrite Z.div_add by lia.
  destruct (divide_pow word (bits - fraction)) as [q Hq]; [lia|].
  rewrite Hq, Z.mul_assoc.
  rewrite Z.mod_add by lia.
  reflexivity.
Qed.

(* model/halfspace/units/depth_plane.hpp, TilePlane::at(): a word in range is known from its low bits. *)
Lemma signed_of_low_bits : forall value bits, 0 < bits ->
  - 2 ^ (bits - 1) <= value < 2 ^ (bits - 1) ->
  (value + 2 ^ (bits - 1)) mod 2 ^ bits - 2 ^ (bits - 1) = value.
Proof.
  intros value bits Hb H.
  assert (2 ^ bits = 2 * 2 ^ (bits - 1)).
  { rewrite <- Z.pow_succ_r by lia. f_equal. lia. }
  rewrite Z.mod_small by lia. lia.
Qed.

(* Additions of words may wrap: only the sum has to be right. *)
Lemma sum_of_low_bits : forall origin x dx y dy m,
  (origin mod m + x * (dx mod m) + y * (dy mod m)) mod m = (origin + x * dx + y * dy) mod m.
Proof.
  intros.
  rewrite (Zplus_mod (origin mod m + x * (dx mod m))), (Zplus_mod (origin mod m)).
  rewrite !Zmult_mod_idemp_r, Zmod_mod.
  rewrite <- (Zplus_mod origin), <- Zplus_mod.
  reflexivity.
Qed.

End Words.

Section Clamp.
Open Scope R_scope.

(* model/halfspace/units/z_test.cpp: the code is clamped to those of the nearest and the farthest vertex. They
   are at most half a unit away from the depths, between which the exact depth is. *)
Theorem clamp_adds_no_error : forall exact code least most least_code most_code off,
  least <= exact <= most ->
  Rabs (least_code - least) <= 1 / 2 -> Rabs (most_code - most) <= 1 / 2 ->
  least_code <= most_code ->
  1 / 2 <= off -> Rabs (code - exact) <= off ->
  Rabs (Rmax least_code (Rmin most_code code) - exact) <= off.
Proof.
  intros exact code least most least_code most_code off Hx Hl Hm Hc Ho H.
  unfold Rmax, Rmin, Rabs in *.
  repeat (destruct Rle_dec in * || destruct Rcase_abs in * ); lra.
Qed.

End Clamp.
