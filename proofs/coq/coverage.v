(* From setup to the mask of a tile: the units cover what the reference covers. *)
Require Import ZArith Lia Bool.
From Halfspace Require Import edge_function fill_rule triangle_cover triangle_order.
From Halfspace Require Import sub_pixel corner_tests saturation widths.
Open Scope Z_scope.

(* edge.c of setup() in model/halfspace/units/setup.cpp, moved to pixel (x, y) as block_walker() and
   tile_walker() do. *)
Definition biased_at (own : Z -> Z -> bool) (s : Z) (i j : point) (x y : Z) : Z :=
  at_pixel s (edge_c s i j - bias own (step_a i j) (step_b i j)) (step_a i j) (step_b i j) x y.

(* SquareEdges: its changes for one pixel. *)
Definition dx (s : Z) (i j : point) : Z := step_a i j * 2 ^ s.
Definition dy (s : Z) (i j : point) : Z := step_b i j * 2 ^ s.

Lemma biased_is_edge : forall own s i j x y,
  biased_at own s i j x y = edge i j (pixel_centre s x y) - bias own (step_a i j) (step_b i j).
Proof. intros; rewrite <- edge_by_pixel_steps; unfold biased_at, at_pixel; ring. Qed.

Lemma biased_is_rule : forall own s i j x y,
  (0 <=? biased_at own s i j x y) = inside own i j (pixel_centre s x y).
Proof. intros; rewrite biased_is_edge; apply bias_is_the_rule. Qed.

(* covered_tiles() of model/halfspace/units/block_walker.hpp tests samples so. *)
Theorem sample_test_is_the_rule : forall own s a b c x y,
  (0 <=? biased_at own s a b x y) && (0 <=? biased_at own s b c x y) && (0 <=? biased_at own s c a x y) =
  covers own a b c (pixel_centre s x y).
Proof. intros; unfold covers; now rewrite !biased_is_rule. Qed.

(* block_walker(): a tile at pixel (tx, ty) that one edge rejects has no sample that is covered. *)
Definition rejects (own : Z -> Z -> bool) (s : Z) (i j : point) (size tx ty : Z) : Prop :=
  biased_at own s i j tx ty + to_largest (dx s i j) (dy s i j) size < 0.

Lemma biased_in_tile : forall own s i j tx ty x y,
  biased_at own s i j (tx + x) (ty + y) = biased_at own s i j tx ty + dx s i j * x + dy s i j * y.
Proof. intros; unfold biased_at, at_pixel, dx, dy; ring. Qed.

Theorem rejected_tile_is_empty : forall own s a b c size tx ty, 0 < size ->
  rejects own s a b size tx ty \/ rejects own s b c size tx ty \/ rejects own s c a size tx ty ->
  forall x y, in_square size x y -> covers own a b c (pixel_centre s (tx + x) (ty + y)) = false.
Proof.
  intros own s a b c size tx ty Hsize Hreject x y Hxy.
  assert (Hone : forall i j, rejects own s i j size tx ty ->
    inside own i j (pixel_centre s (tx + x) (ty + y)) = false).
  { intros i j H; rewrite <- biased_is_rule, biased_in_tile; apply Z.leb_gt.
    exact (proj1 (reject_is_exact _ _ _ size Hsize) H x y Hxy). }
  unfold covers; destruct Hreject as [H | [H | H]]; apply Hone in H; rewrite H; now rewrite ?andb_false_r.
Qed.

(* half_plane() of model/halfspace/units/edge_evaluator.hpp, with the edge's accept bit: tile_walker() sets
   it only where to_least() says so. *)
Definition accepts (own : Z -> Z -> bool) (s : Z) (i j : point) (size tx ty : Z) : Prop :=
  0 <= biased_at own s i j tx ty + to_least (dx s i j) (dy s i j) size.
Definition bit_of_edge (own : Z -> Z -> bool) (s limit : Z) (accept : bool) (i j : point) (tx ty x y : Z) :=
  let local := saturate limit (drop_sub_pixel s (biased_at own s i j tx ty)) in
  accept || (0 <=? local + x * step_a i j + y * step_b i j).

Theorem bit_of_edge_is_the_rule : forall own s t limit accept i j tx ty x y, 0 <= s -> 0 <= t ->
  on_guard_band s i -> on_guard_band s j -> 2 ^ t * 2 ^ step_bits s <= limit -> in_square (2 ^ t) x y ->
  (accept = true -> accepts own s i j (2 ^ t) tx ty) ->
  bit_of_edge own s limit accept i j tx ty x y = inside own i j (pixel_centre s (tx + x) (ty + y)).
Proof.
  intros own s t limit accept i j tx ty x y Hs Ht Hi Hj Hlimit Hxy Haccept.
  rewrite <- biased_is_rule, biased_in_tile; unfold bit_of_edge.
  destruct accept; simpl.
  - assert (Hsize : 0 < 2 ^ t) by (apply Z.pow_pos_nonneg; lia).
    symmetry; apply Z.leb_le.
    exact (proj1 (accept_is_exact _ _ _ (2 ^ t) Hsize) (Haccept eq_refl) x y Hxy).
  - destruct (steps_fit s i j Hs Hi Hj) as [Ha Hb].
    apply eq_true_iff_eq; rewrite !Z.leb_le.
    rewrite (limit_of_the_widths s t limit _ _ _ x y Hs Ht Hlimit Ha Hb Hxy).
    replace (biased_at own s i j tx ty + dx s i j * x + dy s i j * y)
      with (at_pixel s (biased_at own s i j tx ty) (step_a i j) (step_b i j) x y)
      by (unfold at_pixel, dx, dy; ring).
    rewrite (sub_pixel_bits_never_decide s (at_pixel s _ _ _ x y) Hs), pixel_steps_are_exact by exact Hs.
    replace (drop_sub_pixel s (biased_at own s i j tx ty) + x * step_a i j + y * step_b i j)
      with (drop_sub_pixel s (biased_at own s i j tx ty) + step_a i j * x + step_b i j * y) by ring.
    reflexivity.
Qed.

(* sample_bounds() of setup.cpp, for x or y. *)
Definition first_sample (s least : Z) : Z := Z.shiftr (least + 2 ^ (s - 1) - 1) s.
Definition last_sample (s most : Z) : Z := Z.shiftr (most - 2 ^ (s - 1)) s.

(* The pixels whose centres lie between the ends, these included. *)
Theorem sample_bounds_are_exact : forall s least most p, 1 <= s ->
  (first_sample s least <= p <= last_sample s most <-> least <= p * 2 ^ s + 2 ^ (s - 1) <= most).
Proof.
  intros s least most p Hs; unfold first_sample, last_sample; rewrite !Z.shiftr_div_pow2 by lia.
  assert (Hhalf : 2 ^ s = 2 * 2 ^ (s - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  pose proof (Z.pow_pos_nonneg 2 (s - 1) ltac:(lia) ltac:(lia)) as Hp; rewrite Hhalf; clear Hhalf.
  revert Hp; generalize (2 ^ (s - 1)); intros h Hh.
  pose proof (Z.div_mod (least + h - 1) (2 * h) ltac:(lia)).
  pose proof (Z.mod_pos_bound (least + h - 1) (2 * h) ltac:(lia)).
  pose proof (Z.div_mod (most - h) (2 * h) ltac:(lia)).
  pose proof (Z.mod_pos_bound (most - h) (2 * h) ltac:(lia)).
  split; intros [Hfrom Hto]; split; nia.
Qed.

(* No sample outside the bounding box is covered, so setup() loses none. *)
Theorem box_holds_what_is_covered : forall own a b c p, 0 < twice_area a b c -> covers own a b c p = true ->
  Z.min (px a) (Z.min (px b) (px c)) <= px p <= Z.max (px a) (Z.max (px b) (px c)) /\
  Z.min (py a) (Z.min (py b) (py c)) <= py p <= Z.max (py a) (Z.max (py b) (py c)).
Proof.
  intros own a b c p Harea Hcovers.
  assert (Hnot : forall i j, inside own i j p = true -> 0 <= edge i j p).
  { intros i j; unfold inside, inside_of; destruct (Z.compare_spec (edge i j p) 0); intros;
    try discriminate; lia. }
  unfold covers in Hcovers; rewrite !andb_true_iff in Hcovers; destruct Hcovers as [[H1 H2] H3].
  apply Hnot in H1; apply Hnot in H2; apply Hnot in H3.
  pose proof (edges_are_weights a b c p) as [Hx Hy]; pose proof (edges_sum_to_area a b c p) as Hsum.
  revert Harea Hx Hy Hsum H1 H2 H3.
  generalize (twice_area a b c) (edge b c p) (edge c a p) (edge a b p);
    intros area u v w Harea Hx Hy Hsum H1 H2 H3.
  assert (Hmean : forall m x y z, area * m = u * x + v * y + w * z ->
    Z.min x (Z.min y z) <= m <= Z.max x (Z.max y z)).
  { intros m x y z Hm; set (lo := Z.min x (Z.min y z)); set (hi := Z.max x (Z.max y z)).
    assert (u * lo <= u * x <= u * hi) by (unfold lo, hi; nia).
    assert (v * lo <= v * y <= v * hi) by (unfold lo, hi; nia).
    assert (w * lo <= w * z <= w * hi) by (unfold lo, hi; nia).
    split; nia. }
  split; now apply Hmean.
Qed.

(* A bit of the tile's mask, of a tile that is not rejected, for a triangle whose vertices are in any order.
   The mask is cut to scissor, viewport and target behind that. *)
Definition mask_bit (own : Z -> Z -> bool) (s limit : Z) (accept : bool * bool * bool)
    (v : point * point * point) (tx ty x y : Z) : bool :=
  let '(a, b, c) := v in let '(ab, bc, ca) := accept in
  let between least most p := (first_sample s least <=? p) && (p <=? last_sample s most) in
  between (Z.min (px a) (Z.min (px b) (px c))) (Z.max (px a) (Z.max (px b) (px c))) (tx + x) &&
  between (Z.min (py a) (Z.min (py b) (py c))) (Z.max (py a) (Z.max (py b) (py c))) (ty + y) &&
  bit_of_edge own s limit ab a b tx ty x y && bit_of_edge own s limit bc b c tx ty x y &&
  bit_of_edge own s limit ca c a tx ty x y.

Lemma setup_turns_to_positive : forall a b c, twice_area a b c <> 0 ->
  let '(a', b', c') := setup_vertices a b c in 0 < twice_area a' b' c'.
Proof.
  intros a b c Harea; unfold setup_vertices, oriented.
  pose proof (area_of_swapped a b c).
  pose proof (area_of_rotated a b c); pose proof (area_of_rotated b c a).
  pose proof (area_of_rotated a c b); pose proof (area_of_rotated c b a).
  destruct (Z.ltb_spec (twice_area a b c) 0); unfold rotated_to_first;
    repeat match goal with |- context [if ?t then _ else _] => destruct t end; lia.
Qed.

Theorem mask_is_the_reference : forall own s t limit ab bc ca a b c tx ty x y, 1 <= s -> 0 <= t ->
  twice_area a b c <> 0 -> on_guard_band s a -> on_guard_band s b -> on_guard_band s c ->
  2 ^ t * 2 ^ step_bits s <= limit -> in_square (2 ^ t) x y ->
  (let '(a', b', c') := setup_vertices a b c in
   (ab = true -> accepts own s a' b' (2 ^ t) tx ty) /\ (bc = true -> accepts own s b' c' (2 ^ t) tx ty) /\
   (ca = true -> accepts own s c' a' (2 ^ t) tx ty)) ->
  mask_bit own s limit (ab, bc, ca) (setup_vertices a b c) tx ty x y =
  drawn own a b c (pixel_centre s (tx + x) (ty + y)).
Proof.
  intros own s t limit ab bc ca a b c tx ty x y Hs Ht Harea Ha Hb Hc Hlimit Hxy Haccept.
  rewrite <- (setup_keeps_coverage own a b c _ Harea).
  pose proof (setup_turns_to_positive a b c Harea) as Hpositive.
  assert (Hband : let '(a', b', c') := setup_vertices a b c in
    on_guard_band s a' /\ on_guard_band s b' /\ on_guard_band s c').
  { unfold setup_vertices, oriented, rotated_to_first.
    repeat match goal with |- context [if ?d then _ else _] => destruct d end; tauto. }
  destruct (setup_vertices a b c) as [[u v] w]; destruct Haccept as (H1 & H2 & H3);
    destruct Hband as (Hu & Hv & Hw).
  unfold mask_bit.
  rewrite !(bit_of_edge_is_the_rule own s t limit) by (trivial; lia).
  set (p := pixel_centre s (tx + x) (ty + y)).
  rewrite <- !andb_assoc, !(andb_assoc (inside own u v p)); fold (covers own u v w p).
  destruct (covers own u v w p) eqn:Hcovers; [| now rewrite !andb_false_r].
  destruct (box_holds_what_is_covered own u v w p Hpositive Hcovers) as [Hx Hy].
  apply (sample_bounds_are_exact s _ _ (tx + x) Hs) in Hx.
  apply (sample_bounds_are_exact s _ _ (ty + y) Hs) in Hy.
  rewrite !(proj2 (Z.leb_le _ _)) by lia; reflexivity.
Qed.

Print Assumptions sample_test_is_the_rule.
Print Assumptions rejected_tile_is_empty.
Print Assumptions bit_of_edge_is_the_rule.
Print Assumptions sample_bounds_are_exact.
Print Assumptions box_holds_what_is_covered.
Print Assumptions mask_is_the_reference.
