(* The low s bits of an edge value never decide coverage at pixel centres. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function.
Open Scope Z_scope.

(* drop_sub_pixel() of model/halfspace/numerics/edge.hpp, an arithmetic shift. *)
Definition drop_sub_pixel (s e : Z) : Z := Z.shiftr e s.

Lemma at_pixel_in_steps : forall s e a b x y, at_pixel s e a b x y = e + (a * x + b * y) * 2 ^ s.
Proof. intros; unfold at_pixel; ring. Qed.

(* rtl/block_edge.sv keeps these bits once for the triangle. *)
Theorem sub_pixel_bits_are_constant : forall s e a b x y, 0 <= s ->
  at_pixel s e a b x y mod 2 ^ s = e mod 2 ^ s.
Proof.
  intros; rewrite at_pixel_in_steps; apply Z.mod_add.
  pose proof (Z.pow_pos_nonneg 2 s); lia.
Qed.

Theorem sub_pixel_bits_never_decide : forall s e, 0 <= s -> (0 <= e <-> 0 <= drop_sub_pixel s e).
Proof. intros; unfold drop_sub_pixel; symmetry; apply Z.shiftr_nonneg. Qed.

(* So what moves on the walk is the rest, which a pixel changes by a or b. *)
Theorem pixel_steps_are_exact : forall s e a b x y, 0 <= s ->
  drop_sub_pixel s (at_pixel s e a b x y) = drop_sub_pixel s e + a * x + b * y.
Proof.
  intros s e a b x y Hs; unfold drop_sub_pixel; rewrite !Z.shiftr_div_pow2 by exact Hs.
  rewrite at_pixel_in_steps, Z.div_add; [ring |].
  pose proof (Z.pow_pos_nonneg 2 s); lia.
Qed.

(* rtl/block_edge.sv and rtl/tile_edge.sv put the kept bits below what has moved. *)
Theorem sub_pixel_bits_go_back : forall s e a b x y, 0 <= s ->
  (drop_sub_pixel s e + a * x + b * y) * 2 ^ s + e mod 2 ^ s = at_pixel s e a b x y.
Proof.
  intros s e a b x y Hs; unfold drop_sub_pixel; rewrite Z.shiftr_div_pow2 by exact Hs.
  pose proof (Z.div_mod e (2 ^ s)); pose proof (Z.pow_pos_nonneg 2 s).
  rewrite at_pixel_in_steps; nia.
Qed.

Print Assumptions sub_pixel_bits_are_constant.
Print Assumptions sub_pixel_bits_never_decide.
Print Assumptions pixel_steps_are_exact.
Print Assumptions sub_pixel_bits_go_back.
