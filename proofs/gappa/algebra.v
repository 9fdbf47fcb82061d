(* Proves the identities by which Gappa rewrites: put before each proof that Gappa writes. *)
Require Import Gappa.Gappa_library.
From Coq Require Import Reals Lra.

Ltac powers := repeat match goal with
  |- context [Z.pow_pos ?a ?b] => let c := eval vm_compute in (Z.pow_pos a b) in change (Z.pow_pos a b) with c
end.
Ltac algebra := intros; unfold float2R, float10R, Defs.F2R, Float1; simpl; powers; field;
  repeat split; auto; try lra.
