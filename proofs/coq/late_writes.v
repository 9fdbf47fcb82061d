(* Late writes wait in a queue, and nobody sees that they do: what a burst finds in its lines of the z cache
   is what it would find if every burst had written at once. So hi_z_order.v lets a late write happen with
   the test of its burst. *)
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

Lemma done_by_slot : forall w m m' s, m s = m' s -> done m w s = done m' w s.
Proof. intros w m m' s H; unfold done; now rewrite H. Qed.

Lemma all_done_by_slot : forall out m m' s, m s = m' s -> all_done m out s = all_done m' out s.
Proof.
  induction out as [| w out IH]; intros m m' s H; [exact H |].
  unfold all_done in *; simpl; apply IH; now apply done_by_slot.
Qed.

(* The lines as they are, the late writes that are out, the oldest first, and the lines as they would be if
   every burst wrote at once. make_way() has late writes done before a burst until no one that is out meets
   it. What a burst does to its slots at once holds lines that are fetched or replaced. *)
Inductive machine (start : memory) : memory -> list write -> memory -> Prop :=
| machine_start : machine start start [] start
| machine_finishes m w out eager : machine start m (w :: out) eager -> machine start (done m w) out eager
| machine_writes m out eager w : machine start m out eager ->
    (forall o, In o out -> ~ meets (touches w) o) ->
    machine start (done m w) out (done eager w)
| machine_writes_late m out eager w : machine start m out eager ->
    (forall o, In o out -> ~ meets (touches w) o) -> machine start m (out ++ [w]) (done eager w).

Theorem late_writes_are_only_late : forall start m out eager, machine start m out eager ->
  forall s, all_done m out s = eager s.
Proof.
  intros start m out eager H.
  induction H as [| m w out eager _ IH | m out eager w _ IH Hmeets | m out eager w _ IH _]; intro s.
  - reflexivity.
  - exact (IH s).
  - destruct (touches w s) eqn:E.
    + assert (Hout : forall o, In o out -> touches o s = false).
      { intros o Ho; destruct (touches o s) eqn:Eo; [| reflexivity].
        exfalso; apply (Hmeets o Ho); now exists s. }
      rewrite untouched by exact Hout; apply done_by_slot.
      now rewrite <- (IH s), untouched by exact Hout.
    + rewrite (all_done_by_slot out (done m w) m s) by (unfold done; now rewrite E).
      rewrite IH; unfold done; now rewrite E.
  - unfold all_done in *; rewrite fold_left_app; simpl; now apply done_by_slot.
Qed.

(* Nobody sees them: a burst that none meets finds its slots as if all had written at once. *)
Theorem bursts_see_no_late_write : forall start m out eager burst, machine start m out eager ->
  (forall o, In o out -> ~ meets burst o) -> forall s, burst s = true -> m s = eager s.
Proof.
  intros start m out eager burst H Hmeets s Hs.
  rewrite <- (late_writes_are_only_late start m out eager H s); symmetry; apply untouched.
  intros o Ho; destruct (touches o s) eqn:Eo; [| reflexivity].
  exfalso; apply (Hmeets o Ho); now exists s.
Qed.

(* At the end all are done: a flush or a clear finds the same. *)
Theorem all_finished_is_eager : forall start m eager, machine start m [] eager -> forall s, m s = eager s.
Proof. intros start m eager H s; exact (late_writes_are_only_late start m [] eager H s). Qed.
End Queue.

Print Assumptions late_writes_are_only_late.
Print Assumptions bursts_see_no_late_write.
Print Assumptions all_finished_is_eager.
