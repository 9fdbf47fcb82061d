(* Late writes wait in a queue, and nobody sees that they do: what a burst finds in its lines of the z cache is
   what it would find if every burst had written at once. So hi_z_order.v lets a late write happen with the
   test of its burst. *)
Require Import List Bool.
Import ListNotations.

Section Queue.
Variables slot content : Type. (* lines of the z cache; parts of a tile have slots of their own *)

Definition memory := slot -> content.

(* A late write that is out: the slots that it touches, and what it makes of each. ZSlots::meet() of
   model/halfspace/units/late_writes.hpp: two bursts have a slot in common. *)
Record write := Write { touches : slot -> bool; makes : slot -> content -> content }.

Definition done (m : memory) (w : write) : memory := fun s => if touches w s then makes w s (m s) else m s.
Definition all_done (m : memory) (out : list write) : memory := fold_left done out m.

Definition meets (burst : slot -> bool) (w : write) : Prop := exists s, touches w s = true /\ burst s = true.

Lemma untouched : forall out m s, (forall w, In w out -> touches w s = false) -> all_done m out s = m s.
Proof.
  induction out as [| w out IH]; intros m s H; [reflexivity |]; simpl.
  unfold all_done in *; simpl; rewrite IH by (intros; apply H; now right).
  unfold done; now rewrite (H w (or_introl eq_refl)).
Qed.

(* make_way() has done the oldest ones, up to the newest that meets the burst, or more. *)
Theorem way_is_made : forall oldest rest m burst, (forall w, In w rest -> ~ meets burst w) ->
  forall s, burst s = true -> all_done m oldest s = all_done m (oldest ++ rest) s.
Proof.
  intros oldest rest m burst Hrest s Hs; unfold all_done at 2; rewrite fold_left_app.
  symmetry; apply untouched; intros w Hw.
  destruct (touches w s) eqn:E; [| reflexivity]; exfalso; apply (Hrest w Hw); now exists s.
Qed.

(* Those done and those that are left make the same memory as all, so a burst may come at any time. *)
Theorem writes_keep_their_order : forall oldest rest m,
  all_done (all_done m oldest) rest = all_done m (oldest ++ rest).
Proof. intros; unfold all_done; now rewrite fold_left_app. Qed.
End Queue.

Print Assumptions way_is_made.
Print Assumptions writes_keep_their_order.
