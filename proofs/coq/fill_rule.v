(* Fill rules: which of two triangles owns a sample on the edge that they share.

   An edge from i to j has A = y_i - y_j and B = x_j - x_i, with y down and edges that go round with positive
   area, so that the inside has E > 0. A rule says from A and B whether the edge owns its samples. *)
Require Import ZArith Lia Bool.
From Halfspace Require Import edge_function.
Open Scope Z_scope.

(* owns_its_samples() of model/halfspace/numerics/fill_rule.hpp, by the two bits of a rule; `lowered` of
   rtl/setup_edges.sv is its negation. *)
Definition owns_by_bits (bottom right : bool) (a b : Z) : bool :=
  if negb (a =? 0) then Bool.eqb (a <? 0) right else Bool.eqb (b <? 0) bottom.

(* The same rules by the sides that they name. *)
Definition top_left (a b : Z) : bool := (0 <? a) || ((a =? 0) && (0 <? b)).
Definition bottom_left (a b : Z) : bool := (0 <? a) || ((a =? 0) && (b <? 0)).
Definition top_right (a b : Z) : bool := (a <? 0) || ((a =? 0) && (0 <? b)).
Definition bottom_right (a b : Z) : bool := (a <? 0) || ((a =? 0) && (b <? 0)).

(* The sign of the normal (A, B), which points inside, as an order of pairs: its first part that is not 0. *)
Definition normal_sign (a b : Z) : bool :=
  match a ?= 0 with Gt => true | Lt => false | Eq => match b ?= 0 with Gt => true | _ => false end end.

(* Whether p is inside the edge: inside_edge() of model/halfspace/reference/exact_triangle.cpp. *)
Definition inside_of (own : Z -> Z -> bool) (e a b : Z) : bool :=
  match e ?= 0 with Gt => true | Eq => own a b | Lt => false end.
Definition inside (own : Z -> Z -> bool) (i j p : point) : bool :=
  inside_of own (edge i j p) (step_a i j) (step_b i j).

(* setup() subtracts 1 from the constant of edges that do not own their samples. *)
Definition bias (own : Z -> Z -> bool) (a b : Z) : Z := if own a b then 0 else 1.

(* The edge and its reverse: exactly one of them owns. *)
Definition flips (own : Z -> Z -> bool) : Prop :=
  forall a b, ~ (a = 0 /\ b = 0) -> own (- a) (- b) = negb (own a b).

(* Where two edges own, so does one whose normal is the sum of theirs. Only triangles that meet in a vertex
   need it, see triangle_cover.v. *)
Definition adds (own : Z -> Z -> bool) : Prop :=
  forall a b a' b', own a b = true -> own a' b' = true -> own (a + a') (b + b') = true.

Definition fill_rule (own : Z -> Z -> bool) : Prop := flips own /\ adds own.

Ltac compare_all :=
  repeat match goal with
  | |- context [?a <? ?b] => destruct (Z.ltb_spec a b)
  | |- context [?a =? ?b] => destruct (Z.eqb_spec a b)
  | |- context [?a ?= ?b] => destruct (Z.compare_spec a b)
  end; simpl; try reflexivity; try discriminate; try lia.

(* E - bias >= 0 is the rule: what edge_evaluator.hpp tests is what the reference says. *)
Theorem bias_is_the_rule : forall own e a b,
  (0 <=? e - bias own a b) = inside_of own e a b.
Proof.
  intros own e a b; unfold inside_of, bias.
  destruct (own a b), (Z.compare_spec e 0);
    match goal with |- (?l <=? ?r) = _ => destruct (Z.leb_spec l r) end; try reflexivity; lia.
Qed.

(* Exactly one of two triangles that share an edge has the sample inside of it, for every sample. *)
Theorem shared_edge_partitions : forall own, flips own -> forall i j p, i <> j ->
  inside own j i p = negb (inside own i j p).
Proof.
  intros own Hflips [xi yi] [xj yj] p Hij; unfold inside.
  rewrite (edge_reversed (Point xi yi) (Point xj yj)).
  replace (step_a (Point xj yj) (Point xi yi)) with (- step_a (Point xi yi) (Point xj yj))
    by (unfold step_a; ring).
  replace (step_b (Point xj yj) (Point xi yi)) with (- step_b (Point xi yi) (Point xj yj))
    by (unfold step_b; ring).
  assert (Hab : ~ (step_a (Point xi yi) (Point xj yj) = 0 /\ step_b (Point xi yi) (Point xj yj) = 0)).
  { unfold step_a, step_b; simpl; intros [Ha Hb]; apply Hij; f_equal; lia. }
  specialize (Hflips _ _ Hab).
  generalize (edge (Point xi yi) (Point xj yj) p); intro e; unfold inside_of.
  destruct (Z.compare_spec (- e) 0), (Z.compare_spec e 0); try (exfalso; lia); try reflexivity; exact Hflips.
Qed.

(* The same as the units see it: with the bias, exactly one of the two values is not negative. *)
Theorem biased_edges_partition : forall own, flips own -> forall i j p, i <> j ->
  (0 <=? edge j i p - bias own (step_a j i) (step_b j i)) =
  negb (0 <=? edge i j p - bias own (step_a i j) (step_b i j)).
Proof. intros; rewrite !bias_is_the_rule; now apply shared_edge_partitions. Qed.

(* No weaker rule will do: one that partitions the samples of every edge flips. *)
Theorem partition_needs_flips : forall own,
  (forall i j p, i <> j -> inside own j i p = negb (inside own i j p)) -> flips own.
Proof.
  intros own H a b Hab.
  set (i := Point 0 0); set (j := Point b (- a)).
  assert (Hij : i <> j) by (intro E; injection E; lia).
  specialize (H i j i Hij); unfold inside in H.
  replace (edge i j i) with 0 in H by (unfold edge, step_a, step_b, i, j; simpl; ring).
  replace (edge j i i) with 0 in H by (unfold edge, step_a, step_b, i, j; simpl; ring).
  replace (step_a i j) with a in H by (unfold step_a, i, j; simpl; ring).
  replace (step_b i j) with b in H by (unfold step_b, i, j; simpl; ring).
  replace (step_a j i) with (- a) in H by (unfold step_a, i, j; simpl; ring).
  replace (step_b j i) with (- b) in H by (unfold step_b, i, j; simpl; ring).
  exact H.
Qed.

Ltac is_a_rule own :=
  split; [intros ? *; unfold own; compare_all |];
  intros a b a' b'; unfold own; rewrite !orb_true_iff, !andb_true_iff, !Z.ltb_lt, !Z.eqb_eq; lia.

Theorem top_left_is_a_rule : fill_rule top_left.
Proof. is_a_rule top_left. Qed.

Theorem bottom_left_is_a_rule : fill_rule bottom_left.
Proof. is_a_rule bottom_left. Qed.

Theorem top_right_is_a_rule : fill_rule top_right.
Proof. is_a_rule top_right. Qed.

Theorem bottom_right_is_a_rule : fill_rule bottom_right.
Proof. is_a_rule bottom_right. Qed.

(* The two bits name the sides, for every edge, whose A and B are not both 0. *)
Theorem bits_name_the_sides : forall a b, ~ (a = 0 /\ b = 0) ->
  owns_by_bits false false a b = top_left a b /\ owns_by_bits true false a b = bottom_left a b /\
  owns_by_bits false true a b = top_right a b /\ owns_by_bits true true a b = bottom_right a b.
Proof.
  intros a b Hab; unfold owns_by_bits, top_left, bottom_left, top_right, bottom_right.
  repeat split; compare_all; exfalso; apply Hab; lia.
Qed.

(* Which coincide: the sign of the normal is the top-left rule; right rules are left ones turned round. *)
Theorem normal_sign_is_top_left : forall a b, normal_sign a b = top_left a b.
Proof. intros; unfold normal_sign, top_left; compare_all. Qed.

Theorem bottom_right_is_top_left_turned : forall a b, bottom_right a b = top_left (- a) (- b).
Proof. intros; unfold bottom_right, top_left; compare_all. Qed.

Theorem top_right_is_bottom_left_turned : forall a b, top_right a b = bottom_left (- a) (- b).
Proof. intros; unfold top_right, bottom_left; compare_all. Qed.

(* Why A > 0 is called left: along a row the inside begins there, to the right of the edge. *)
Theorem left_edge : forall i j on p, step_a i j <> 0 -> edge i j on = 0 -> 0 < edge i j p -> py p = py on ->
  (0 < step_a i j <-> px on < px p).
Proof.
  intros i j on p Ha Hon Hp Hrow.
  assert (0 < step_a i j * (px p - px on)).
  { replace (step_a i j * (px p - px on)) with (edge i j p - edge i j on); [lia |].
    unfold edge; rewrite Hrow; ring. }
  split; nia.
Qed.

(* Why A = 0 and B > 0 is called top: the inside is below the edge. *)
Theorem top_edge : forall i j on p, step_a i j = 0 -> edge i j on = 0 -> 0 < edge i j p ->
  (0 < step_b i j <-> py on < py p).
Proof.
  intros i j on p Ha Hon Hp.
  assert (0 < step_b i j * (py p - py on)).
  { replace (step_b i j * (py p - py on)) with (edge i j p - edge i j on); [lia |].
    unfold edge; rewrite Ha; ring. }
  split; nia.
Qed.

(* owns_its_samples() of exact_triangle.cpp, by the ends of the edge. *)
Definition reference_owns (top : bool) (i j : point) : bool :=
  if negb (py j =? py i) then py j <? py i else if top then px i <? px j else px j <? px i.

Theorem reference_has_these_rules : forall i j,
  reference_owns true i j = top_left (step_a i j) (step_b i j) /\
  reference_owns false i j = bottom_left (step_a i j) (step_b i j).
Proof. intros; unfold reference_owns, top_left, bottom_left, step_a, step_b; split; compare_all. Qed.

Print Assumptions bias_is_the_rule.
Print Assumptions shared_edge_partitions.
Print Assumptions biased_edges_partition.
Print Assumptions partition_needs_flips.
Print Assumptions top_left_is_a_rule.
Print Assumptions bottom_left_is_a_rule.
Print Assumptions top_right_is_a_rule.
Print Assumptions bottom_right_is_a_rule.
Print Assumptions bits_name_the_sides.
Print Assumptions normal_sign_is_top_left.
Print Assumptions bottom_right_is_top_left_turned.
Print Assumptions top_right_is_bottom_left_turned.
Print Assumptions left_edge.
Print Assumptions top_edge.
Print Assumptions reference_has_these_rules.
