(* The edge function: the forms in which reference, model and RTL compute it are equal, over all integers.

   Points are in units of 1/2^s pixel with y down, as GridPoint of
   model/halfspace/reference/exact_triangle.hpp and ScreenVertex of model/halfspace/units/setup.cpp. *)
Require Import ZArith Lia.
Open Scope Z_scope.

Record point := Point { px : Z; py : Z }.

(* twice_area() of model/halfspace/reference/exact_triangle.cpp: positive where a, b, c run clockwise on the
   screen. *)
Definition twice_area (a b c : point) : Z :=
  (px b - px a) * (py c - py a) - (px c - px a) * (py b - py a).

(* edge.a and edge.b of setup() in model/halfspace/units/setup.cpp, of the edge from i to j. *)
Definition step_a (i j : point) : Z := py i - py j.
Definition step_b (i j : point) : Z := px j - px i.

(* E of docs/numerics.md, "Edges and coverage". *)
Definition edge (i j p : point) : Z := step_a i j * (px p - px i) + step_b i j * (py p - py i).

(* pixel_centre() of exact_triangle.cpp. *)
Definition pixel_centre (s x y : Z) : point := Point (x * 2 ^ s + 2 ^ (s - 1)) (y * 2 ^ s + 2 ^ (s - 1)).

(* edge.c of setup(), before the fill rule's 1 is subtracted: E at the centre of pixel (0, 0). *)
Definition edge_c (s : Z) (i j : point) : Z :=
  step_a i j * (2 ^ (s - 1) - px i) + step_b i j * (2 ^ (s - 1) - py i).

(* SquareEdges::at() of model/halfspace/units/square_edges.hpp: one edge, by the pixel. *)
Definition at_pixel (s e a b x y : Z) : Z := e + a * 2 ^ s * x + b * 2 ^ s * y.

Theorem edge_is_cross_product : forall i j p, edge i j p = twice_area i j p.
Proof. intros; unfold edge, twice_area, step_a, step_b; ring. Qed.

(* A x + B y + C with C = E at the origin of the window. *)
Theorem edge_is_line : forall i j p,
  edge i j p = step_a i j * px p + step_b i j * py p + edge i j (Point 0 0).
Proof. intros; unfold edge, step_a, step_b; simpl; ring. Qed.

(* C of setup(), and pixel steps from there. *)
Theorem edge_by_pixel_steps : forall s i j x y,
  at_pixel s (edge_c s i j) (step_a i j) (step_b i j) x y = edge i j (pixel_centre s x y).
Proof. intros; unfold at_pixel, edge_c, edge, step_a, step_b, pixel_centre; simpl; ring. Qed.

(* rtl/setup_edges.sv takes edges 1 and 2 relative to vertex 0, which ends the one and begins the other. *)
Theorem edge_from_either_end : forall i j p,
  edge i j p = step_a i j * (px p - px j) + step_b i j * (py p - py j).
Proof. intros; unfold edge, step_a, step_b; ring. Qed.

Theorem edge_reversed : forall i j p, edge j i p = - edge i j p.
Proof. intros; unfold edge, step_a, step_b; ring. Qed.

(* rtl/setup_edges.sv finds E of edge 0 as 2A less the others. *)
Theorem edges_sum_to_area : forall a b c p, edge a b p + edge b c p + edge c a p = twice_area a b c.
Proof. intros; unfold edge, twice_area, step_a, step_b; ring. Qed.

(* The E are the weights of the vertices in every point of the plane. *)
Theorem edges_are_weights : forall a b c p,
  twice_area a b c * px p = edge b c p * px a + edge c a p * px b + edge a b p * px c /\
  twice_area a b c * py p = edge b c p * py a + edge c a p * py b + edge a b p * py c.
Proof. intros; unfold edge, twice_area, step_a, step_b; split; ring. Qed.

Print Assumptions edge_is_cross_product.
Print Assumptions edge_is_line.
Print Assumptions edge_by_pixel_steps.
Print Assumptions edge_from_either_end.
Print Assumptions edge_reversed.
Print Assumptions edges_sum_to_area.
Print Assumptions edges_are_weights.
