(* False: the bounds of the jobs that are seen hold whatever is in flight. *)
Require Import ZArith Lia Bool List.
From Halfspace Require Import hi_z hi_z_order.
Import ListNotations.
Open Scope Z_scope.

(* A job that writes 9 to a tile of one sample that holds 5. *)
Definition raises : job unit :=
  Job unit Always true false (fun _ => true) (fun _ => 9) (fun _ => true) 9 9 (fun _ => true).

Theorem flight_not_counted : ~ forall (part : unit -> Z) start seen b, known unit part start seen b ->
  forall flight x, after unit start (seen ++ flight) x <= most b (part x).
Proof.
  intro H; assert (Hhigh : ~ 9 <= 5) by lia; apply Hhigh.
  refine (H (fun _ => 0) (fun _ => 5) [] (Bounds (fun _ => 5) (fun _ => 5)) _ [raises] tt).
  apply known_start; intro x; simpl; lia.
Qed.

Print Assumptions flight_not_counted.
