(* Trivial reject and accept of a square of samples by one corner. *)
Require Import ZArith Lia.
From Halfspace Require Import edge_function sub_pixel.
Open Scope Z_scope.

(* SquareEdges of model/halfspace/units/square_edges.hpp: dx and dy are a and b times 2^s, size is T. *)
Definition to_largest (dx dy size : Z) : Z := (Z.max dx 0 + Z.max dy 0) * (size - 1).
Definition to_least (dx dy size : Z) : Z := (Z.min dx 0 + Z.min dy 0) * (size - 1).

Definition in_square (size x y : Z) : Prop := 0 <= x < size /\ 0 <= y < size.

Lemma largest_is_a_bound : forall dx dy size x y, in_square size x y ->
  dx * x + dy * y <= to_largest dx dy size.
Proof.
  intros dx dy size x y [Hx Hy]; unfold to_largest.
  assert (dx * x <= Z.max dx 0 * (size - 1)) by nia.
  assert (dy * y <= Z.max dy 0 * (size - 1)) by nia.
  lia.
Qed.

Lemma least_is_a_bound : forall dx dy size x y, in_square size x y ->
  to_least dx dy size <= dx * x + dy * y.
Proof.
  intros dx dy size x y [Hx Hy]; unfold to_least.
  assert (Z.min dx 0 * (size - 1) <= dx * x) by nia.
  assert (Z.min dy 0 * (size - 1) <= dy * y) by nia.
  lia.
Qed.

(* Both bounds are attained at corner samples. *)
Theorem bounds_are_attained : forall dx dy size, 0 < size ->
  (exists x y, in_square size x y /\ (x = 0 \/ x = size - 1) /\ (y = 0 \/ y = size - 1) /\
    dx * x + dy * y = to_largest dx dy size) /\
  (exists x y, in_square size x y /\ (x = 0 \/ x = size - 1) /\ (y = 0 \/ y = size - 1) /\
    dx * x + dy * y = to_least dx dy size).
Proof.
  intros dx dy size Hsize; unfold in_square, to_largest, to_least; split.
  - exists (if dx <? 0 then 0 else size - 1), (if dy <? 0 then 0 else size - 1).
    destruct (Z.ltb_spec dx 0), (Z.ltb_spec dy 0);
      rewrite ?(Z.max_l dx 0), ?(Z.max_r dx 0), ?(Z.max_l dy 0), ?(Z.max_r dy 0) by lia;
      repeat split; try lia; try ring.
  - exists (if dx <? 0 then size - 1 else 0), (if dy <? 0 then size - 1 else 0).
    destruct (Z.ltb_spec dx 0), (Z.ltb_spec dy 0);
      rewrite ?(Z.min_l dx 0), ?(Z.min_r dx 0), ?(Z.min_l dy 0), ?(Z.min_r dy 0) by lia;
      repeat split; try lia; try ring.
Qed.

(* block_walker() rejects exactly the tiles that have no sample inside the half plane. *)
Theorem reject_is_exact : forall e dx dy size, 0 < size ->
  (e + to_largest dx dy size < 0 <-> forall x y, in_square size x y -> e + dx * x + dy * y < 0).
Proof.
  intros e dx dy size Hsize; split.
  - intros H x y Hxy; pose proof (largest_is_a_bound dx dy size x y Hxy); lia.
  - intro H; destruct (bounds_are_attained dx dy size Hsize) as [(x & y & Hxy & _ & _ & E) _].
    specialize (H x y Hxy); lia.
Qed.

(* tile_walker() accepts exactly the tiles that have all samples inside it. *)
Theorem accept_is_exact : forall e dx dy size, 0 < size ->
  (0 <= e + to_least dx dy size <-> forall x y, in_square size x y -> 0 <= e + dx * x + dy * y).
Proof.
  intros e dx dy size Hsize; split.
  - intros H x y Hxy; pose proof (least_is_a_bound dx dy size x y Hxy); lia.
  - intro H; destruct (bounds_are_attained dx dy size Hsize) as [_ (x & y & Hxy & _ & _ & E)].
    specialize (H x y Hxy); lia.
Qed.

(* rtl/block_edge.sv and rtl/tile_edge.sv test by the pixel, without the sub-pixel bits: same verdicts. *)
Theorem corner_tests_by_the_pixel : forall s e a b size, 0 <= s ->
  (drop_sub_pixel s e + to_largest a b size < 0 <->
     e + to_largest (a * 2 ^ s) (b * 2 ^ s) size < 0) /\
  (0 <= drop_sub_pixel s e + to_least a b size <->
     0 <= e + to_least (a * 2 ^ s) (b * 2 ^ s) size).
Proof.
  intros s e a b size Hs; unfold drop_sub_pixel; rewrite Z.shiftr_div_pow2 by exact Hs.
  pose proof (Z.pow_pos_nonneg 2 s ltac:(lia) Hs) as Hp.
  assert (Hl : to_largest (a * 2 ^ s) (b * 2 ^ s) size = to_largest a b size * 2 ^ s).
  { unfold to_largest; replace 0 with (0 * 2 ^ s) at 1 2 by ring.
    rewrite !Z.mul_max_distr_nonneg_r by lia; ring. }
  assert (Hs' : to_least (a * 2 ^ s) (b * 2 ^ s) size = to_least a b size * 2 ^ s).
  { unfold to_least; replace 0 with (0 * 2 ^ s) at 1 2 by ring.
    rewrite !Z.mul_min_distr_nonneg_r by lia; ring. }
  rewrite Hl, Hs'; clear Hl Hs'.
  generalize (to_largest a b size) (to_least a b size); intros l m.
  pose proof (Z.div_mod e (2 ^ s)); pose proof (Z.mod_pos_bound e (2 ^ s) Hp).
  split; split; nia.
Qed.

Print Assumptions bounds_are_attained.
Print Assumptions reject_is_exact.
Print Assumptions accept_is_exact.
Print Assumptions corner_tests_by_the_pixel.
