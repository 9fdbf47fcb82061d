(* Triangles that meet cover each sample once: on both sides of an edge, around a vertex on an edge of
   another (a T-junction whose vertex is on the grid), and around a vertex inside. *)
Require Import ZArith Lia Bool.
From Halfspace Require Import edge_function fill_rule.
Open Scope Z_scope.

(* covers() of model/halfspace/reference/exact_triangle.cpp for a triangle of positive area. *)
Definition covers (own : Z -> Z -> bool) (a b c p : point) : bool :=
  inside own a b p && inside own b c p && inside own c a p.

(* E, A and B of an edge together say whether a sample is inside. inside_of() is a rule of its own for these
   triples, which adds and flips as the fill rule does; and every relation between the edges of triangles is
   one between such triples. *)
Section Triples.
  Variable own : Z -> Z -> bool.
  Hypothesis rule : fill_rule own.

  Lemma inside_of_flips : forall e a b, ~ (a = 0 /\ b = 0) ->
    inside_of own (- e) (- a) (- b) = negb (inside_of own e a b).
  Proof.
    intros e a b Hab; unfold inside_of.
    destruct (Z.compare_spec (- e) 0), (Z.compare_spec e 0); try (exfalso; lia); try reflexivity.
    now apply (proj1 rule).
  Qed.

  Lemma inside_of_adds : forall e a b e' a' b',
    inside_of own e a b = true -> inside_of own e' a' b' = true ->
    inside_of own (e + e') (a + a') (b + b') = true.
  Proof.
    intros e a b e' a' b'; unfold inside_of.
    destruct (Z.compare_spec e 0), (Z.compare_spec e' 0), (Z.compare_spec (e + e') 0);
      try (exfalso; lia); try reflexivity; try discriminate.
    apply (proj2 rule).
  Qed.

  Lemma inside_of_multiple : forall k, 0 < k -> forall e a b,
    inside_of own e a b = true -> inside_of own (k * e) (k * a) (k * b) = true.
  Proof.
    intros k Hk e a b H.
    replace k with (Z.succ (k - 1)) by lia.
    assert (Hk1 : 0 <= k - 1) by lia.
    generalize dependent (k - 1); intros m Hm; clear Hk.
    pattern m; apply natlike_ind; [| | exact Hm].
    - replace (Z.succ 0) with 1 by lia; now rewrite !Z.mul_1_l.
    - intros n Hn IH.
      replace (Z.succ (Z.succ n) * e) with (Z.succ n * e + e) by ring.
      replace (Z.succ (Z.succ n) * a) with (Z.succ n * a + a) by ring.
      replace (Z.succ (Z.succ n) * b) with (Z.succ n * b + b) by ring.
      now apply inside_of_adds.
  Qed.

  Lemma inside_of_scales : forall k, 0 < k -> forall e a b,
    inside_of own (k * e) (k * a) (k * b) = inside_of own e a b.
  Proof.
    intros k Hk e a b.
    destruct (inside_of own e a b) eqn:H; [now apply inside_of_multiple |].
    destruct (Z.eq_dec a 0) as [Ha | Ha]; [destruct (Z.eq_dec b 0) as [Hb | Hb] |].
    - subst; rewrite !Z.mul_0_r; revert H; unfold inside_of.
      destruct (Z.compare_spec e 0), (Z.compare_spec (k * e) 0); try reflexivity; try discriminate;
        try (exfalso; nia); trivial.
    - assert (Hab : ~ (a = 0 /\ b = 0)) by tauto.
      assert (Hkab : ~ (k * a = 0 /\ k * b = 0)) by nia.
      assert (Hm : inside_of own (k * - e) (k * - a) (k * - b) = true).
      { apply inside_of_multiple; [exact Hk |]; rewrite inside_of_flips by exact Hab; now rewrite H. }
      replace (k * - e) with (- (k * e)) in Hm by ring; replace (k * - a) with (- (k * a)) in Hm by ring.
      replace (k * - b) with (- (k * b)) in Hm by ring.
      rewrite inside_of_flips in Hm by exact Hkab.
      now apply negb_true_iff in Hm.
    - assert (Hab : ~ (a = 0 /\ b = 0)) by tauto.
      assert (Hkab : ~ (k * a = 0 /\ k * b = 0)) by nia.
      assert (Hm : inside_of own (k * - e) (k * - a) (k * - b) = true).
      { apply inside_of_multiple; [exact Hk |]; rewrite inside_of_flips by exact Hab; now rewrite H. }
      replace (k * - e) with (- (k * e)) in Hm by ring; replace (k * - a) with (- (k * a)) in Hm by ring.
      replace (k * - b) with (- (k * b)) in Hm by ring.
      rewrite inside_of_flips in Hm by exact Hkab.
      now apply negb_true_iff in Hm.
  Qed.

  (* One edge is a positive multiple of another: both are parts of one line. *)
  Lemma same_line : forall i j i' j' p k k', 0 < k -> 0 < k' ->
    k * edge i j p = k' * edge i' j' p -> k * step_a i j = k' * step_a i' j' ->
    k * step_b i j = k' * step_b i' j' -> inside own i j p = inside own i' j' p.
  Proof.
    intros i j i' j' p k k' Hk Hk' He Ha Hb; unfold inside.
    rewrite <- (inside_of_scales k Hk), <- (inside_of_scales k' Hk' (edge i' j' p)).
    now rewrite He, Ha, Hb.
  Qed.

  (* One edge is a sum of positive multiples of two others: inside both is inside it. *)
  Lemma between_lines : forall i j i1 j1 i2 j2 p k k1 k2, 0 < k -> 0 < k1 -> 0 < k2 ->
    k * edge i j p = k1 * edge i1 j1 p + k2 * edge i2 j2 p ->
    k * step_a i j = k1 * step_a i1 j1 + k2 * step_a i2 j2 ->
    k * step_b i j = k1 * step_b i1 j1 + k2 * step_b i2 j2 ->
    inside own i1 j1 p = true -> inside own i2 j2 p = true -> inside own i j p = true.
  Proof.
    intros i j i1 j1 i2 j2 p k k1 k2 Hk Hk1 Hk2 He Ha Hb H1 H2; unfold inside in *.
    rewrite <- (inside_of_scales k Hk), He, Ha, Hb.
    apply inside_of_adds; now apply inside_of_multiple.
  Qed.
End Triples.

(* Two triangles on both sides of an edge: no sample is covered twice. Their order and other vertices do not
   matter. *)
Theorem neighbours_never_overlap : forall own, flips own -> forall i j k l p, i <> j ->
  covers own i j k p && covers own j i l p = false.
Proof.
  intros own Hflips i j k l p Hij; unfold covers.
  rewrite (shared_edge_partitions own Hflips i j p Hij).
  now destruct (inside own i j p); rewrite ?andb_false_r.
Qed.

(* A point strictly between a and b, by the edges of the triangle, and by its weights. *)
Theorem point_between_by_weights : forall a b c d, 0 < twice_area a b c ->
  (edge a b d = 0 /\ 0 < edge b c d /\ 0 < edge c a d <->
   exists m n, 0 < m /\ 0 < n /\ (m + n) * px d = m * px a + n * px b /\
               (m + n) * py d = m * py a + n * py b).
Proof.
  intros a b c d Harea; split.
  - intros (Hab & Hbc & Hca); exists (edge b c d), (edge c a d).
    pose proof (edges_are_weights a b c d) as [Hx Hy].
    pose proof (edges_sum_to_area a b c d) as Hsum.
    rewrite Hab, Z.mul_0_l, Z.add_0_r in Hx, Hy; rewrite Hab, Z.add_0_l in Hsum.
    now rewrite Hsum.
  - intros (m & n & Hm & Hn & Hx & Hy).
    assert (H1 : (m + n) * edge a b d = 0).
    { replace ((m + n) * edge a b d) with
        (step_a a b * ((m + n) * px d - (m + n) * px a) + step_b a b * ((m + n) * py d - (m + n) * py a))
        by (unfold edge; ring).
      rewrite Hx, Hy; unfold step_a, step_b; ring. }
    assert (H2 : (m + n) * edge b c d = m * twice_area a b c).
    { replace ((m + n) * edge b c d) with
        (step_a b c * ((m + n) * px d - (m + n) * px b) + step_b b c * ((m + n) * py d - (m + n) * py b))
        by (unfold edge; ring).
      rewrite Hx, Hy; unfold step_a, step_b, twice_area; ring. }
    assert (H3 : (m + n) * edge c a d = n * twice_area a b c).
    { replace ((m + n) * edge c a d) with
        (step_a c a * ((m + n) * px d - (m + n) * px c) + step_b c a * ((m + n) * py d - (m + n) * py c))
        by (unfold edge; ring).
      rewrite Hx, Hy; unfold step_a, step_b, twice_area; ring. }
    repeat split; nia.
Qed.

Lemma distinct : forall i j k, 0 < twice_area i j k -> i <> j /\ j <> k /\ k <> i.
Proof. intros i j k H; repeat split; intro E; subst; unfold twice_area in H; lia. Qed.

(* Relations between edges that begin or end in d, of which the E of d are the weights. *)
Ltac by_weights := unfold edge, step_a, step_b, twice_area; ring.

(* A triangle a b c is split at a point d of its edge from a to b, which need not be the middle. Of the parts
   as many cover a sample as of the whole: one or none. *)
Theorem split_at_edge_point : forall own, fill_rule own -> forall a b c d p,
  0 < twice_area a b c -> edge a b d = 0 -> 0 < edge b c d -> 0 < edge c a d ->
  Z.b2z (covers own a d c p) + Z.b2z (covers own d b c p) = Z.b2z (covers own a b c p).
Proof.
  intros own rule a b c d p Harea Hd Hl Hm.
  assert (Had : inside own a d p = inside own a b p).
  { apply (same_line own rule) with (twice_area a b c) (edge c a d); trivial.
    - transitivity (edge c a d * edge a b p + edge a b d * edge a c p); [by_weights | rewrite Hd; ring].
    - transitivity (edge c a d * step_a a b + edge a b d * step_a a c); [by_weights | rewrite Hd; ring].
    - transitivity (edge c a d * step_b a b + edge a b d * step_b a c); [by_weights | rewrite Hd; ring]. }
  assert (Hdb : inside own d b p = inside own a b p).
  { apply (same_line own rule) with (twice_area a b c) (edge b c d); trivial.
    - transitivity (edge b c d * edge a b p + edge a b d * edge c b p); [by_weights | rewrite Hd; ring].
    - transitivity (edge b c d * step_a a b + edge a b d * step_a c b); [by_weights | rewrite Hd; ring].
    - transitivity (edge b c d * step_b a b + edge a b d * step_b c b); [by_weights | rewrite Hd; ring]. }
  assert (Hbc : inside own d c p = true -> inside own c a p = true -> inside own b c p = true).
  { apply (between_lines own rule) with (edge c a d) (twice_area a b c) (edge b c d); trivial; by_weights. }
  assert (Hca : inside own b c p = true -> inside own c d p = true -> inside own c a p = true).
  { apply (between_lines own rule) with (edge b c d) (edge c a d) (twice_area a b c); trivial; by_weights. }
  assert (Hcd : inside own c d p = negb (inside own d c p)).
  { apply shared_edge_partitions; [exact (proj1 rule) |]; intro E; subst d.
    unfold edge in Hl; unfold step_a, step_b in Hl; lia. }
  unfold covers; rewrite Had, Hdb, Hcd in *.
  destruct (inside own a b p), (inside own b c p), (inside own c a p), (inside own d c p); simpl in *;
    try reflexivity; try (discriminate Hbc; reflexivity); try (discriminate Hca; reflexivity).
Qed.

(* A triangle is split into three at a point inside. *)
Theorem split_at_inner_point : forall own, fill_rule own -> forall a b c d p,
  0 < edge a b d -> 0 < edge b c d -> 0 < edge c a d ->
  Z.b2z (covers own a b d p) + Z.b2z (covers own b c d p) + Z.b2z (covers own c a d p) =
  Z.b2z (covers own a b c p).
Proof.
  intros own rule a b c d p Hn Hl Hm.
  assert (Harea : 0 < twice_area a b c) by (rewrite <- (edges_sum_to_area a b c d); lia).
  assert (Ha : d <> a /\ d <> b /\ d <> c).
  { repeat split; intro E; subst d; unfold edge, step_a, step_b in *; lia. }
  destruct Ha as (Hda & Hdb & Hdc).
  pose proof (shared_edge_partitions own (proj1 rule) d a p Hda) as Hfa.
  pose proof (shared_edge_partitions own (proj1 rule) d b p Hdb) as Hfb.
  pose proof (shared_edge_partitions own (proj1 rule) d c p Hdc) as Hfc.
  (* Inside the corner at d between a and b and inside the edge ab: inside the other two edges. *)
  assert (H1 : inside own a b p = true -> inside own b d p = true -> inside own b c p = true).
  { apply (between_lines own rule) with (edge a b d) (edge b c d) (twice_area a b c); trivial; by_weights. }
  assert (H2 : inside own a b p = true -> inside own d a p = true -> inside own c a p = true).
  { apply (between_lines own rule) with (edge a b d) (edge c a d) (twice_area a b c); trivial; by_weights. }
  assert (H3 : inside own b c p = true -> inside own c d p = true -> inside own c a p = true).
  { apply (between_lines own rule) with (edge b c d) (edge c a d) (twice_area a b c); trivial; by_weights. }
  assert (H4 : inside own b c p = true -> inside own d b p = true -> inside own a b p = true).
  { apply (between_lines own rule) with (edge b c d) (edge a b d) (twice_area a b c); trivial; by_weights. }
  assert (H5 : inside own c a p = true -> inside own a d p = true -> inside own a b p = true).
  { apply (between_lines own rule) with (edge c a d) (edge a b d) (twice_area a b c); trivial; by_weights. }
  assert (H6 : inside own c a p = true -> inside own d c p = true -> inside own b c p = true).
  { apply (between_lines own rule) with (edge c a d) (edge b c d) (twice_area a b c); trivial; by_weights. }
  (* The three edges at d are not all passed on the same side. *)
  assert (H7 : inside own d a p = true -> inside own d b p = true -> inside own c d p = true).
  { apply (between_lines own rule) with (edge a b d) (edge b c d) (edge c a d); trivial; by_weights. }
  assert (H8 : inside own a d p = true -> inside own b d p = true -> inside own d c p = true).
  { apply (between_lines own rule) with (edge a b d) (edge b c d) (edge c a d); trivial; by_weights. }
  unfold covers; rewrite Hfa, Hfb, Hfc in *.
  destruct (inside own a b p), (inside own b c p), (inside own c a p), (inside own d a p),
    (inside own d b p), (inside own d c p); simpl in *;
    try reflexivity; exfalso; intuition discriminate.
Qed.

(* So two of the parts never cover the same sample, and no sample of the whole is left out. *)
Theorem parts_have_area : forall a b c d,
  twice_area a b d = edge a b d /\ twice_area b c d = edge b c d /\ twice_area c a d = edge c a d /\
  (edge a b d = 0 -> twice_area a d c = edge c a d /\ twice_area d b c = edge b c d).
Proof.
  intros; unfold edge, twice_area, step_a, step_b; repeat split; lia.
Qed.

Print Assumptions neighbours_never_overlap.
Print Assumptions point_between_by_weights.
Print Assumptions split_at_edge_point.
Print Assumptions split_at_inner_point.
Print Assumptions parts_have_area.
