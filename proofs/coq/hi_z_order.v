(* Hi-Z's bounds hold although they are old: what a block sees is a matter of order, and jobs in flight take
   away the ends of the bounds that they may have moved. So nothing that is stored changes.

   One tile of one surface. Its jobs are in the order in which they leave hi_z, which is the order in which
   early_z tests their bursts; jobs of other tiles do not touch what is stored in it. A job that came to no
   burst covers no sample. *)
Require Import ZArith Lia Bool List.
From Halfspace Require Import hi_z.
Import ListNotations.
Open Scope Z_scope.

Section Tile.
Variable sample : Type.
Variable part : sample -> Z. (* of the tile: each has bounds of its own *)

Definition image := sample -> Z. (* the stored codes *)

Record job := Job {
  func : depth_func;
  writes : bool;            (* EarlyZState::write *)
  late : bool;              (* EarlyZState::late *)
  covered : sample -> bool;
  code : sample -> Z;
  kept : sample -> bool;    (* by the shader, which may discard where the draw is late *)
  min_code : Z;             (* of the depth equation: interpolation clamps to these *)
  max_code : Z;
  touched : Z -> bool       (* parts that the burst tells hi_z of *)
}.

(* touches_depth() of model/halfspace/units/z_test.hpp for a draw that tests. *)
Definition touches_depth (j : job) : bool :=
  match func j with Never => false | Always => writes j | _ => true end.

Record well_formed (j : job) : Prop := {
  clamped : forall x, covered j x = true -> min_code j <= code j x <= max_code j;
  keeps_all : late j = false -> forall x, kept j x = true;
  tells_of_all : touches_depth j = true -> forall x, covered j x = true -> touched j (part x) = true
}.

(* z_test() of model/halfspace/units/z_test.cpp and the late write behind it. `sure`: all pass, untested. *)
Definition passed (sure : bool) (j : job) (s : image) (x : sample) : bool :=
  covered j x && (sure || passes (func j) (code j x) (s x)).
Definition stored_after (sure : bool) (j : job) (s : image) : image :=
  fun x => if passed sure j s x && writes j && kept j x then code j x else s x.

(* depth_moves() of model/halfspace/units/hi_z_bounds.hpp. *)
Definition moves_up (j : job) : bool :=
  writes j && match func j with Always | NotEqual | Greater | Gequal => true | _ => false end.
Definition moves_down (j : job) : bool :=
  writes j && match func j with Always | NotEqual | Less | Lequal => true | _ => false end.

Lemma stored_or_code : forall sure j s x,
  stored_after sure j s x = s x \/ (covered j x = true /\ stored_after sure j s x = code j x).
Proof.
  intros; unfold stored_after, passed.
  destruct (covered j x), (sure || _), (writes j), (kept j x); simpl; auto.
Qed.

Ltac by_function :=
  intros j s x; unfold moves_up, moves_down, stored_after, passed;
  destruct (covered j x), (writes j), (kept j x), (func j); simpl; intro; try discriminate; try lia;
  match goal with |- context [if ?c then _ else _] => let E := fresh "E" in destruct c eqn:E;
    rewrite ?andb_true_r, ?Z.ltb_lt, ?Z.leb_le, ?Z.eqb_eq in E; lia
  end.

Theorem stored_moves_up_only : forall j s x, moves_down j = false -> s x <= stored_after false j s x.
Proof. by_function. Qed.

Theorem stored_moves_down_only : forall j s x, moves_up j = false -> stored_after false j s x <= s x.
Proof. by_function. Qed.

(* Bounds of the parts. *)
Record bounds := Bounds { least : Z -> Z; most : Z -> Z }.

Definition holds (b : bounds) (s : image) : Prop := forall x, least b (part x) <= s x <= most b (part x).
Definition outward (b wider : bounds) : Prop :=
  forall q, least wider q <= least b q /\ most b q <= most wider q.

(* hi_z_update(), and allow_for_late_write() where the draw is late: of the parts that are touched, what
   `told` has, which holds for what is stored after the test but before a late write. Others keep theirs. *)
Definition update (j : job) (told b : bounds) : bounds :=
  let allowed_least q := if late j && moves_down j then Z.min (least told q) (min_code j) else least told q in
  let allowed_most q := if late j && moves_up j then Z.max (most told q) (max_code j) else most told q in
  Bounds (fun q => if touched j q then allowed_least q else least b q)
         (fun q => if touched j q then allowed_most q else most b q).

Theorem update_holds : forall sure j s told b, well_formed j ->
  (sure = true -> late j = false /\ touches_depth j = true) ->
  holds b s -> holds told (if late j then s else stored_after sure j s) ->
  holds (update j told b) (stored_after sure j s).
Proof.
  intros sure j s told b Hj Hsure Hb Htold x; unfold update; cbn [least most].
  destruct (touched j (part x)) eqn:Etouched.
  - destruct (late j) eqn:Elate; simpl; [| exact (Htold x)].
    assert (E : sure = false) by (destruct sure; [destruct (Hsure eq_refl); congruence | reflexivity]).
    rewrite E; clear E; specialize (Htold x).
    pose proof (clamped j Hj x) as Hclamped.
    destruct (stored_or_code false j s x) as [E | [Hc E]].
    + rewrite E; destruct (moves_down j), (moves_up j); lia.
    + specialize (Hclamped Hc).
      pose proof (stored_moves_up_only j s x) as Hup; pose proof (stored_moves_down_only j s x) as Hdown.
      destruct (moves_down j), (moves_up j); try specialize (Hup eq_refl); try specialize (Hdown eq_refl);
        lia.
  - (* No part of the burst, or a draw that writes nothing. *)
    replace (stored_after sure j s x) with (s x); [exact (Hb x) |].
    destruct (stored_or_code sure j s x) as [E | [Hc E]]; [now rewrite E |].
    destruct (touches_depth j) eqn:Et.
    + now rewrite (tells_of_all j Hj Et x Hc) in Etouched.
    + assert (Es : sure = false) by (destruct sure; [destruct (Hsure eq_refl); congruence | reflexivity]).
      subst sure; unfold stored_after, passed; unfold touches_depth in Et.
      destruct (func j), (writes j); try discriminate; simpl; now rewrite ?andb_false_r.
Qed.

(* What was stored at the beginning: of a frame, where nothing is known, or by a fast clear, which sees all
   jobs and sets all bounds to its code. *)
Variable start : image.

(* Without hi_z: what is stored after these jobs. *)
Definition after (jobs : list job) : image := fold_left (fun s j => stored_after false j s) jobs start.

Lemma after_one_more : forall jobs j, after (jobs ++ [j]) = stored_after false j (after jobs).
Proof. intros; unfold after; now rewrite fold_left_app. Qed.

(* What the word of the block says of the tile when it has the updates of these jobs. Rounding happens where
   bounds of another tile are put in, too. *)
Inductive known : list job -> bounds -> Prop :=
| known_start b : holds b start -> known [] b
| known_update seen j told b : known seen b -> well_formed j ->
    holds told (if late j then after seen else after (seen ++ [j])) -> known (seen ++ [j]) (update j told b)
| known_rounded seen b wider : known seen b -> outward b wider -> known seen wider.

Theorem known_bounds_hold : forall seen b, known seen b -> holds b (after seen).
Proof.
  intros seen b Hknown; induction Hknown as [b Hb | seen j told b _ IH Hj Htold | seen b wider _ IH Hout].
  - exact Hb.
  - rewrite after_one_more in *; apply update_holds; trivial; discriminate.
  - intro x; specialize (IH x); specialize (Hout (part x)); lia.
Qed.

(* raising_ and lowering_ of HiZ: jobs in flight that may move an end. *)
Definition raising (flight : list job) : nat := length (filter moves_up flight).
Definition lowering (flight : list job) : nat := length (filter moves_down flight).

(* However many jobs are in flight, and whether their writes have happened or not. *)
Theorem old_bounds_hold : forall seen b, known seen b -> forall flight x,
  (lowering flight = 0%nat -> least b (part x) <= after (seen ++ flight) x) /\
  (raising flight = 0%nat -> after (seen ++ flight) x <= most b (part x)).
Proof.
  intros seen b Hknown flight x; pose proof (known_bounds_hold seen b Hknown x) as H0.
  unfold raising, lowering; induction flight as [| j flight IH] using rev_ind.
  - rewrite app_nil_r; lia.
  - rewrite app_assoc, after_one_more, !filter_app, !app_length; simpl.
    pose proof (stored_moves_up_only j (after (seen ++ flight)) x).
    pose proof (stored_moves_down_only j (after (seen ++ flight)) x).
    destruct (moves_up j), (moves_down j); simpl in *; lia.
Qed.

(* HiZ::decide() on a tile of a block: after `left` jobs of the tile have left, of which `seen` are seen. The
   lag may be any. HiZ::bounds() unites those of the parts. *)
Definition decides (result : outcome) (j : job) (left : list job) : Prop :=
  exists seen flight b l m at_least below,
    left = seen ++ flight /\ known seen b /\
    (forall x, l <= least b (part x) /\ most b (part x) <= m) /\
    (forall c, at_least c = true -> forall x, covered j x = true -> c <= code j x) /\
    (forall c, below c = true -> forall x, covered j x = true -> code j x < c) /\
    test (func j) at_least below l m (Nat.eqb (lowering flight) 0) (Nat.eqb (raising flight) 0) = result.

Theorem rejected_by_old_bounds : forall j left, decides NonePasses j left ->
  forall x, passed false j (after left) x = false.
Proof.
  intros j left (seen & flight & b & l & m & at_least & below & E & Hknown & Hlm & Hat & Hbelow & Htest) x.
  subst left; unfold passed; destruct (covered j x) eqn:Hx; [simpl | reflexivity].
  pose proof (reject_is_sound {y : sample | covered j y = true} (fun y => code j (proj1_sig y))
    (fun y => after (seen ++ flight) (proj1_sig y)) at_least below) as Hsound.
  refine (Hsound _ _ l m _ _ _ _ (func j) Htest (exist _ x Hx)).
  - intros c Hc [y Hy]; now apply Hat.
  - intros c Hc [y Hy]; now apply Hbelow.
  - intros Hcount [y Hy]; apply Nat.eqb_eq in Hcount; simpl.
    pose proof (proj1 (old_bounds_hold seen b Hknown flight y) Hcount); specialize (Hlm y); lia.
  - intros Hcount [y Hy]; apply Nat.eqb_eq in Hcount; simpl.
    pose proof (proj2 (old_bounds_hold seen b Hknown flight y) Hcount); specialize (Hlm y); lia.
Qed.

Theorem accepted_by_old_bounds : forall j left, decides AllPass j left ->
  forall x, passed false j (after left) x = covered j x.
Proof.
  intros j left (seen & flight & b & l & m & at_least & below & E & Hknown & Hlm & Hat & Hbelow & Htest) x.
  subst left; unfold passed; destruct (covered j x) eqn:Hx; [simpl | reflexivity].
  pose proof (accept_is_sound {y : sample | covered j y = true} (fun y => code j (proj1_sig y))
    (fun y => after (seen ++ flight) (proj1_sig y)) at_least below) as Hsound.
  refine (Hsound _ _ l m _ _ _ _ (func j) Htest (exist _ x Hx)).
  - intros c Hc [y Hy]; now apply Hat.
  - intros c Hc [y Hy]; now apply Hbelow.
  - intros Hcount [y Hy]; apply Nat.eqb_eq in Hcount; simpl.
    pose proof (proj1 (old_bounds_hold seen b Hknown flight y) Hcount); specialize (Hlm y); lia.
  - intros Hcount [y Hy]; apply Nat.eqb_eq in Hcount; simpl.
    pose proof (proj2 (old_bounds_hold seen b Hknown flight y) Hcount); specialize (Hlm y); lia.
Qed.

(* All jobs, those that have left hi_z, and what is then stored. *)
Inductive machine : list job -> list job -> image -> Prop :=
| machine_start : machine [] [] start
| machine_leaves all left s j : machine all left s ->
    machine (all ++ [j]) (left ++ [j]) (stored_after false j s)
| machine_sure all left s j : machine all left s -> decides AllPass j left ->
    machine (all ++ [j]) (left ++ [j]) (stored_after true j s)
| machine_rejects all left s j : machine all left s -> decides NonePasses j left ->
    machine (all ++ [j]) left s.

Lemma passed_by_sample : forall sure j s s' x, s x = s' x -> passed sure j s x = passed sure j s' x.
Proof. intros; unfold passed; now rewrite H. Qed.

Lemma stored_by_sample : forall sure j s s' x, s x = s' x ->
  stored_after sure j s x = stored_after sure j s' x.
Proof. intros; unfold stored_after; now rewrite (passed_by_sample sure j s s' x H), H. Qed.

(* With hi_z the same is stored as without, after every job. *)
Theorem hi_z_stores_the_same : forall all left s, machine all left s ->
  forall x, s x = after left x /\ s x = after all x.
Proof.
  intros all left s Hmachine.
  induction Hmachine as [| all left s j _ IH | all left s j _ IH Hall | all left s j _ IH Hnone]; intro x.
  - split; reflexivity.
  - destruct (IH x) as [Hl Ha]; rewrite !after_one_more; split; now apply stored_by_sample.
  - destruct (IH x) as [Hl Ha]; rewrite !after_one_more.
    assert (E : stored_after true j s x = stored_after false j s x).
    { unfold stored_after; rewrite (passed_by_sample false j s (after left) x Hl).
      rewrite (accepted_by_old_bounds j left Hall x); unfold passed; simpl; now rewrite andb_true_r. }
    rewrite E; split; now apply stored_by_sample.
  - destruct (IH x) as [Hl Ha]; split; [exact Hl |]; rewrite after_one_more.
    rewrite <- (stored_by_sample false j s (after all) x Ha).
    unfold stored_after; rewrite (passed_by_sample false j s (after left) x Hl).
    now rewrite (rejected_by_old_bounds j left Hnone x).
Qed.

(* And the same samples pass: of a rejected job none, of a sure one all. *)
Theorem hi_z_passes_the_same : forall all left s j, machine all left s -> forall x,
  passed false j s x = passed false j (after all) x /\
  (decides NonePasses j left -> passed false j (after all) x = false) /\
  (decides AllPass j left -> passed true j s x = passed false j (after all) x).
Proof.
  intros all left s j Hmachine x; destruct (hi_z_stores_the_same all left s Hmachine x) as [Hl Ha].
  assert (E : after left x = after all x) by congruence.
  repeat split.
  - now apply passed_by_sample.
  - intro H; rewrite <- (passed_by_sample false j (after left) (after all) x E).
    now apply rejected_by_old_bounds.
  - intro H; rewrite <- (passed_by_sample false j (after left) (after all) x E).
    rewrite (accepted_by_old_bounds j left H x); unfold passed; simpl; now rewrite andb_true_r.
Qed.
End Tile.

(* hi_z_must_see() of model/halfspace/units/hi_z.hpp: a block sees as many jobs as the block before it or
   more, and only such as had left when the block five before it was decided. *)
Definition must_see (before lag seen : Z) : Z := Z.max seen (before - Z.min before lag).

Theorem seen_jobs_have_left : forall before lag seen, 0 <= lag -> 0 <= seen <= before ->
  seen <= must_see before lag seen <= before.
Proof. intros; unfold must_see; lia. Qed.

Print Assumptions stored_moves_up_only.
Print Assumptions stored_moves_down_only.
Print Assumptions update_holds.
Print Assumptions known_bounds_hold.
Print Assumptions old_bounds_hold.
Print Assumptions rejected_by_old_bounds.
Print Assumptions accepted_by_old_bounds.
Print Assumptions hi_z_stores_the_same.
Print Assumptions hi_z_passes_the_same.
Print Assumptions seen_jobs_have_left.
