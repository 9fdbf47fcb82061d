(* What does not change coverage: which vertex comes first, the winding, and where on the screen a triangle
   lies. *)
Require Import ZArith Lia Bool.
From Halfspace Require Import edge_function fill_rule triangle_cover.
Open Scope Z_scope.

Theorem rotation_keeps_coverage : forall own a b c p, covers own b c a p = covers own a b c p.
Proof.
  intros; unfold covers.
  now destruct (inside own a b p), (inside own b c p), (inside own c a p).
Qed.

Definition moved (by_ p : point) : point := Point (px p + px by_) (py p + py by_).

Theorem translation_keeps_coverage : forall own t a b c p,
  covers own (moved t a) (moved t b) (moved t c) (moved t p) = covers own a b c p.
Proof.
  assert (Hedge : forall own t i j p, inside own (moved t i) (moved t j) (moved t p) = inside own i j p).
  { intros; unfold inside, moved; f_equal; unfold edge, step_a, step_b; simpl; ring. }
  intros; unfold covers; now rewrite !Hedge.
Qed.

(* By whole pixels, samples move to samples: the mask moves along. *)
Theorem whole_pixels_keep_coverage : forall own s u v a b c x y,
  let t := Point (u * 2 ^ s) (v * 2 ^ s) in
  covers own (moved t a) (moved t b) (moved t c) (pixel_centre s (x + u) (y + v)) =
  covers own a b c (pixel_centre s x y).
Proof.
  intros; rewrite <- (translation_keeps_coverage own t a b c); f_equal.
  unfold t, moved, pixel_centre; simpl; f_equal; ring.
Qed.

(* setup() and clockwise() swap the last two vertices of a triangle of negative area. *)
Definition oriented (a b c : point) : point * point * point :=
  if twice_area a b c <? 0 then (a, c, b) else (a, b, c).

(* covers() of model/halfspace/reference/exact_triangle.cpp, for either winding. *)
Definition drawn (own : Z -> Z -> bool) (a b c p : point) : bool :=
  if twice_area a b c =? 0 then false
  else let '(a', b', c') := oriented a b c in covers own a' b' c' p.

Lemma area_of_swapped : forall a b c, twice_area a c b = - twice_area a b c.
Proof. intros; unfold twice_area; ring. Qed.

Lemma area_of_rotated : forall a b c, twice_area b c a = twice_area a b c.
Proof. intros; unfold twice_area; ring. Qed.

Theorem winding_keeps_coverage : forall own a b c p, drawn own a c b p = drawn own a b c p.
Proof.
  intros; unfold drawn, oriented; rewrite area_of_swapped.
  destruct (Z.eqb_spec (- twice_area a b c) 0), (Z.eqb_spec (twice_area a b c) 0); try reflexivity; try lia.
  destruct (Z.ltb_spec (- twice_area a b c) 0), (Z.ltb_spec (twice_area a b c) 0); try reflexivity; lia.
Qed.

(* With the swap these are all orders of the three vertices. *)
Theorem order_keeps_coverage : forall own a b c p, drawn own b c a p = drawn own a b c p.
Proof.
  intros; unfold drawn, oriented; rewrite area_of_rotated.
  destruct (twice_area a b c =? 0); [reflexivity |].
  destruct (twice_area a b c <? 0); [| now apply rotation_keeps_coverage].
  now rewrite <- (rotation_keeps_coverage own b a c), <- (rotation_keeps_coverage own a c b).
Qed.

(* `above` of rotate_to_first() in model/halfspace/units/setup.cpp; min_element() takes the first. *)
Definition above (l r : point) : bool := (py l <? py r) || ((py l =? py r) && (px l <? px r)).

Definition rotated_to_first (t : point * point * point) : point * point * point :=
  let '(a, b, c) := t in
  if above b a then (if above c b then (c, a, b) else (b, c, a))
  else (if above c a then (c, a, b) else (a, b, c)).

Definition setup_vertices (a b c : point) : point * point * point := rotated_to_first (oriented a b c).

(* Equal triangles give equal equations: all orders of the vertices, of either winding, end in one. *)
Theorem setup_forgets_order : forall a b c, twice_area a b c <> 0 ->
  setup_vertices b c a = setup_vertices a b c /\ setup_vertices a c b = setup_vertices a b c.
Proof.
  intros a b c Harea; unfold setup_vertices, oriented; rewrite (area_of_rotated a b c).
  rewrite (area_of_swapped a b c).
  assert (Htotal : forall u v, u <> v -> above v u = negb (above u v)).
  { intros [xu yu] [xv yv] Hne.
    assert (~ (xu = xv /\ yu = yv)) by (intros [E1 E2]; apply Hne; now f_equal).
    unfold above; simpl; compare_all. }
  assert (Htrans : forall u v w, above u v = true -> above v w = true -> above u w = true).
  { intros u v w; unfold above; compare_all. }
  assert (Hd : a <> b /\ b <> c /\ a <> c).
  { repeat split; intro E; subst; apply Harea; unfold twice_area; ring. }
  destruct Hd as (Hd1 & Hd2 & Hd3).
  pose proof (Htrans a b c) as Habc; pose proof (Htrans c b a) as Hcba.
  rewrite (Htotal _ _ Hd1), (Htotal _ _ Hd2), (Htotal _ _ Hd3) in *.
  destruct (Z.ltb_spec (- twice_area a b c) 0), (Z.ltb_spec (twice_area a b c) 0); try lia; simpl;
    rewrite ?(Htotal _ _ Hd1), ?(Htotal _ _ Hd2), ?(Htotal _ _ Hd3);
    destruct (above a b), (above b c), (above a c); simpl in *;
    split; try reflexivity; first [discriminate Habc; reflexivity | discriminate Hcba; reflexivity].
Qed.

Theorem setup_keeps_coverage : forall own a b c p, twice_area a b c <> 0 ->
  (let '(a', b', c') := setup_vertices a b c in covers own a' b' c' p) = drawn own a b c p.
Proof.
  intros own a b c p Harea; unfold setup_vertices, drawn.
  destruct (Z.eqb_spec (twice_area a b c) 0) as [| _]; [lia |].
  destruct (oriented a b c) as [[u v] w]; unfold rotated_to_first.
  destruct (above v u), (above w v), (above w u);
    first [reflexivity | apply rotation_keeps_coverage | symmetry; apply rotation_keeps_coverage].
Qed.

Print Assumptions rotation_keeps_coverage.
Print Assumptions translation_keeps_coverage.
Print Assumptions whole_pixels_keep_coverage.
Print Assumptions winding_keeps_coverage.
Print Assumptions order_keeps_coverage.
Print Assumptions setup_forgets_order.
Print Assumptions setup_keeps_coverage.
