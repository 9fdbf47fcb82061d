(* An edge value that is moved by steps is the value that is computed directly, whatever the way. *)
Require Import ZArith Lia List.
From Halfspace Require Import edge_function sub_pixel.
Import ListNotations.
Open Scope Z_scope.

(* A way of steps of whole squares of any sizes, forwards and backwards: of a pixel, a tile, a block. *)
Inductive move := Right (pixels : Z) | Down (pixels : Z).

Definition moved_value (a b e : Z) (m : move) : Z :=
  match m with Right n => e + a * n | Down n => e + b * n end.
Definition moved_place (p : Z * Z) (m : move) : Z * Z :=
  match m with Right n => (fst p + n, snd p) | Down n => (fst p, snd p + n) end.

Theorem any_way_is_direct : forall a b way e x y,
  fold_left (moved_value a b) way (e + a * x + b * y) =
  let '(x', y') := fold_left moved_place way (x, y) in e + a * x' + b * y'.
Proof.
  intros a b way; induction way as [| [n | n] way IH]; intros e x y; simpl; [reflexivity | |].
  - replace (e + a * x + b * y + a * n) with (e + a * (x + n) + b * y) by ring; apply IH.
  - replace (e + a * x + b * y + b * n) with (e + a * x + b * (y + n)) by ring; apply IH.
Qed.

(* SquareEdges::at() from a block to its tile, and from there to a sample, is at() of the sample. *)
Theorem at_pixel_from_a_square : forall s e a b x y x' y',
  at_pixel s (at_pixel s e a b x y) a b x' y' = at_pixel s e a b (x + x') (y + y').
Proof. intros; unfold at_pixel; ring. Qed.

(* here_q and row_q of rtl/block_edge.sv: along a row by size * a; at its end down from the row's beginning
   by size * b. *)
Definition along (size a : Z) (here : Z) : Z := here + a * size.
Definition walked_row (size a b : Z) (row : Z) (steps : nat) : Z := Nat.iter steps (along size a) row.
Definition row_start (size b e : Z) (rows : nat) : Z := Nat.iter rows (fun row => row + b * size) e.

Theorem row_walk_is_direct : forall size a b e rows steps,
  walked_row size a b (row_start size b e rows) steps =
  e + a * (size * Z.of_nat steps) + b * (size * Z.of_nat rows).
Proof.
  intros size a b e rows steps; unfold walked_row, row_start, along.
  assert (Hrow : Nat.iter rows (fun row => row + b * size) e = e + b * (size * Z.of_nat rows)).
  { induction rows as [| n IH]; [simpl; ring |].
    cbn [Nat.iter nat_rect]; unfold Nat.iter in IH; rewrite IH, Nat2Z.inj_succ; ring. }
  rewrite Hrow; induction steps as [| n IH]; [simpl; ring |].
  cbn [Nat.iter nat_rect]; unfold Nat.iter in IH; rewrite IH, Nat2Z.inj_succ; ring.
Qed.

(* The tree of rtl/edge_steps.sv: level l makes rows 2^l to 2^(l+1) - 1 from those before. *)
Theorem row_tree_is_direct : forall origin b (row : Z -> Z) levels,
  row 0 = origin ->
  (forall level i, 0 <= level < levels -> 0 <= i < 2 ^ level ->
    row (2 ^ level + i) = row i + b * 2 ^ level) ->
  forall i, 0 <= i < 2 ^ levels -> row i = origin + i * b.
Proof.
  intros origin b row levels H0 Hstep.
  assert (Hall : forall n, 0 <= n -> n <= levels -> forall i, 0 <= i < 2 ^ n -> row i = origin + i * b).
  { intros n Hn; pattern n; apply natlike_ind; [| | exact Hn].
    - intros _ i Hi; replace i with 0 by (simpl in Hi; lia); rewrite H0; ring.
    - intros m Hm IH Hle i Hi; rewrite Z.pow_succ_r in Hi by exact Hm.
      destruct (Z.lt_ge_cases i (2 ^ m)); [apply IH; lia |].
      replace i with (2 ^ m + (i - 2 ^ m)) at 1 by ring.
      rewrite Hstep by lia; rewrite IH by lia; ring. }
  intros i Hi; destruct (Z.le_gt_cases 0 levels); [apply (Hall levels); lia |].
  rewrite Z.pow_neg_r in Hi by lia; lia.
Qed.

(* The sum that edge_evaluator.hpp and rtl/edge_signs.sv take: rows and columns are made apart. *)
Theorem row_and_column : forall origin a b x y, (origin + y * b) + x * a = origin + x * a + y * b.
Proof. intros; ring. Qed.

Print Assumptions any_way_is_direct.
Print Assumptions at_pixel_from_a_square.
Print Assumptions row_walk_is_direct.
Print Assumptions row_tree_is_direct.
Print Assumptions row_and_column.
