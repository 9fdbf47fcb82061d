(* Hi-Z's verdicts on a tile are sound: where it says that none passes, none does; where it says that all
   pass, all do. What the bounds are and when they hold is in hi_z_bounds.v, hi_z_plane.v, hi_z_order.v. *)
Require Import ZArith Lia Bool.
Open Scope Z_scope.

(* DepthFunc and depth_passes() of model/halfspace/numerics/depth.hpp. *)
Inductive depth_func := Never | Less | Equal | Lequal | Greater | NotEqual | Gequal | Always.

Definition passes (func : depth_func) (incoming stored : Z) : bool :=
  match func with
  | Never => false
  | Less => incoming <? stored
  | Equal => incoming =? stored
  | Lequal => incoming <=? stored
  | Greater => stored <? incoming
  | NotEqual => negb (incoming =? stored)
  | Gequal => stored <=? incoming
  | Always => true
  end.

Inductive outcome := Unknown | NonePasses | AllPass.

(* test() of model/halfspace/units/hi_z.cpp. `at_least c`: it is known that all codes of the triangle in the
   tile are c or more, `below c` that all are less. *)
Definition test (func : depth_func) (at_least_known below_known : Z -> bool) (least most : Z)
    (least_counts most_counts : bool) : outcome :=
  let at_least code := most_counts && at_least_known code in
  let below code := least_counts && below_known code in
  let result (none all : bool) := if none then NonePasses else if all then AllPass else Unknown in
  match func with
  | Never => NonePasses
  | Less => result (at_least most) (below least)
  | Lequal => result (at_least (most + 1)) (below (least + 1))
  | Equal => result (at_least (most + 1) || below least) false
  | Greater => result (below (least + 1)) (at_least (most + 1))
  | Gequal => result (below least) (at_least most)
  | NotEqual => result false (at_least (most + 1) || below least)
  | Always => AllPass
  end.

Section Verdicts.
  (* Samples of the tile that the triangle covers, with their codes and what is stored at their test. *)
  Variable sample : Type.
  Variables incoming stored : sample -> Z.

  Variables at_least_known below_known : Z -> bool.
  Hypothesis at_least_sound : forall code, at_least_known code = true -> forall x, code <= incoming x.
  Hypothesis below_sound : forall code, below_known code = true -> forall x, incoming x < code.

  (* An end of the bounds holds where it counts. *)
  Variables least most : Z.
  Variables least_counts most_counts : bool.
  Hypothesis least_holds : least_counts = true -> forall x, least <= stored x.
  Hypothesis most_holds : most_counts = true -> forall x, stored x <= most.

  Ltac use_knowledge x :=
    repeat match goal with
    | H : _ || _ = true |- _ => apply orb_true_iff in H; destruct H as [H | H]
    | H : _ && _ = true |- _ => apply andb_true_iff in H; destruct H
    | H : at_least_known _ = true |- _ => pose proof (at_least_sound _ H x); clear H
    | H : below_known _ = true |- _ => pose proof (below_sound _ H x); clear H
    | H : least_counts = true |- _ => pose proof (least_holds H x); clear H
    | H : most_counts = true |- _ => pose proof (most_holds H x); clear H
    end.

  Ltac by_function :=
    intros func H x; unfold test in H;
    destruct func; simpl in *;
    repeat match type of H with
    | (if ?c then _ else _) = _ => let E := fresh "E" in destruct c eqn:E; try discriminate
    end; try discriminate; try reflexivity;
    clear H; use_knowledge x;
    rewrite ?negb_true_iff, ?Z.ltb_lt, ?Z.ltb_ge, ?Z.leb_le, ?Z.leb_gt, ?Z.eqb_neq; lia.

  Theorem reject_is_sound : forall func,
    test func at_least_known below_known least most least_counts most_counts = NonePasses ->
    forall x, passes func (incoming x) (stored x) = false.
  Proof. by_function. Qed.

  Theorem accept_is_sound : forall func,
    test func at_least_known below_known least most least_counts most_counts = AllPass ->
    forall x, passes func (incoming x) (stored x) = true.
  Proof. by_function. Qed.
End Verdicts.

(* Of codes from `low` to `high` against stored codes from `least` to `most`, the rules of the tables in
   docs/units/hi_z.md say all that can be said. Two verdicts are left out: where both ranges are the same
   single code, NOTEQUAL has none that passes, and EQUAL only such. *)
Section Tables.
  Variables low high least most : Z.
  Hypothesis codes : low <= high.
  Hypothesis bounds : least <= most.

  Definition verdict (func : depth_func) : outcome :=
    test func (fun code => code <=? low) (fun code => high <? code) least most true true.

  Definition all_within (func : depth_func) (result : bool) : Prop :=
    forall i s, low <= i <= high -> least <= s <= most -> passes func i s = result.

  Ltac as_order :=
    rewrite ?negb_true_iff, ?negb_false_iff, ?Z.ltb_lt, ?Z.ltb_ge, ?Z.leb_le, ?Z.leb_gt, ?Z.eqb_neq,
      ?Z.eqb_eq in *.

  Ltac decide_tests :=
    repeat match goal with
    | |- context [?a <? ?b] => destruct (Z.ltb_spec a b)
    | |- context [?a <=? ?b] => destruct (Z.leb_spec a b)
    end; simpl.

  (* The ends of both ranges, and a code of both where there is one, are the witnesses. *)
  Ltac by_witness H :=
    exfalso;
    pose proof (H low least ltac:(lia) ltac:(lia)); pose proof (H low most ltac:(lia) ltac:(lia));
    pose proof (H high least ltac:(lia) ltac:(lia)); pose proof (H high most ltac:(lia) ltac:(lia));
    try pose proof (H (Z.max low least) (Z.max low least) ltac:(lia) ltac:(lia));
    simpl in *; as_order; first [discriminate | lia].

  Theorem reject_is_complete : forall func, func <> NotEqual ->
    (verdict func = NonePasses <-> all_within func false).
  Proof.
    intros func Hfunc; unfold verdict, all_within, test; destruct func; try (now destruct Hfunc);
      decide_tests;
      (split;
       [ intros E; try discriminate E; intros i s Hi Hs; simpl; first [reflexivity | as_order; lia]
       | intro Hall; try reflexivity; by_witness Hall ]).
  Qed.

  Theorem accept_is_complete : forall func, func <> Equal ->
    (verdict func = AllPass <-> all_within func true).
  Proof.
    intros func Hfunc; unfold verdict, all_within, test; destruct func; try (now destruct Hfunc);
      decide_tests;
      (split;
       [ intros E; try discriminate E; intros i s Hi Hs; simpl; first [reflexivity | as_order; lia]
       | intro Hall; try reflexivity; by_witness Hall ]).
  Qed.
End Tables.

Print Assumptions reject_is_sound.
Print Assumptions accept_is_sound.
Print Assumptions reject_is_complete.
Print Assumptions accept_is_complete.
