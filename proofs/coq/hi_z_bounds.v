(* What Hi-Z keeps: the word of a block, in which bounds share a base and a shift. Rounding is outwards.
   Entries are functions of their number here, so a word has any number of them. *)
Require Import ZArith Lia Bool.
Open Scope Z_scope.

(* HiZWord of model/halfspace/units/hi_z_bounds.hpp. *)
Record word := Word { base : Z; shift : Z; least_steps : Z -> Z; most_steps : Z -> Z }.

(* HiZWord::entry(). *)
Definition entry_least (w : word) (i : Z) : Z := base w + Z.shiftl (least_steps w i) (shift w).
Definition entry_most (w : word) (i : Z) : Z := base w + Z.shiftl (most_steps w i + 1) (shift w) - 1.

(* The end of put_entries(): `first` and `last` are what all entries span. *)
Definition rounded (first last sh : Z) (least most : Z -> Z) : word :=
  let b := Z.shiftl (Z.shiftr first sh) sh in
  Word b sh (fun i => Z.shiftr (least i - b) sh) (fun i => Z.shiftr (most i - b) sh).

(* cleared_word() and unknown_word(). *)
Definition cleared (code : Z) : word := Word code 0 (fun _ => 0) (fun _ => 0).
Definition unknown (bits : Z) : word :=
  Word 0 (32 - bits) (fun _ => 0) (fun _ => Z.shiftr (2 ^ 32 - 1) (32 - bits)).

(* With steps of 2^sh codes the bounds of the block do not fit `bits`: the loop of put_entries() goes on. *)
Definition too_many (first last bits sh : Z) : Prop := 2 ^ bits <= Z.shiftr last sh - Z.shiftr first sh.

Ltac by_steps sh :=
  rewrite ?Z.shiftl_mul_pow2, ?Z.shiftr_div_pow2 in * by lia;
  pose proof (Z.pow_pos_nonneg 2 sh ltac:(lia) ltac:(lia)).

(* (v - base) in whole steps is v in whole steps less those of the base. *)
Lemma steps_from_base : forall first v sh, 0 <= sh ->
  Z.shiftr (v - Z.shiftl (Z.shiftr first sh) sh) sh = Z.shiftr v sh - Z.shiftr first sh.
Proof.
  intros first v sh Hsh; by_steps sh.
  replace (v - first / 2 ^ sh * 2 ^ sh) with (v + - (first / 2 ^ sh) * 2 ^ sh) by ring.
  rewrite Z.div_add by lia; ring.
Qed.

(* rtl/hi_z_word.sv: rounding clears the bits below a step in least bounds, and sets them in most. *)
Theorem rounding_changes_bits_below_a_step : forall first last sh least most i, 0 <= sh ->
  let w := rounded first last sh least most in
  entry_least w i = least i - least i mod 2 ^ sh /\
  entry_most w i = most i - most i mod 2 ^ sh + (2 ^ sh - 1).
Proof.
  intros first last sh least most i Hsh w; unfold w, entry_least, entry_most, rounded;
    cbn [base shift least_steps most_steps].
  rewrite !steps_from_base by exact Hsh; by_steps sh.
  pose proof (Z.div_mod (least i) (2 ^ sh) ltac:(lia)); pose proof (Z.div_mod (most i) (2 ^ sh) ltac:(lia)).
  split; nia.
Qed.

Theorem rounding_is_outward : forall first last sh least most i, 0 <= sh ->
  let w := rounded first last sh least most in
  least i - 2 ^ sh < entry_least w i <= least i /\ most i <= entry_most w i < most i + 2 ^ sh.
Proof.
  intros first last sh least most i Hsh w.
  destruct (rounding_changes_bits_below_a_step first last sh least most i Hsh) as [Hl Hm]; fold w in Hl, Hm.
  pose proof (Z.pow_pos_nonneg 2 sh ltac:(lia) Hsh) as Hp.
  pose proof (Z.mod_pos_bound (least i) (2 ^ sh) Hp); pose proof (Z.mod_pos_bound (most i) (2 ^ sh) Hp).
  lia.
Qed.

(* Steps of entries fit `bits` where the loop of put_entries() has stopped. *)
Theorem steps_fit_bits : forall first last bits sh least most i, 0 <= sh ->
  first <= least i -> least i <= most i -> most i <= last -> ~ too_many first last bits sh ->
  let w := rounded first last sh least most in
  0 <= least_steps w i < 2 ^ bits /\ 0 <= most_steps w i < 2 ^ bits.
Proof.
  intros first last bits sh least most i Hsh Hl Hlm Hm Hfit w; unfold too_many in Hfit.
  unfold w, rounded; cbn [least_steps most_steps]; rewrite !steps_from_base by exact Hsh; by_steps sh.
  assert (first / 2 ^ sh <= least i / 2 ^ sh) by (apply Z.div_le_mono; lia).
  assert (least i / 2 ^ sh <= most i / 2 ^ sh) by (apply Z.div_le_mono; lia).
  assert (most i / 2 ^ sh <= last / 2 ^ sh) by (apply Z.div_le_mono; lia).
  lia.
Qed.

(* The loop stops at 32 - bits at the latest. *)
Theorem shift_is_found : forall first last bits, 0 <= bits <= 32 -> 0 <= first -> last < 2 ^ 32 ->
  ~ too_many first last bits (32 - bits).
Proof.
  unfold too_many; intros first last bits Hbits Hfirst Hlast; by_steps (32 - bits).
  assert (0 <= first / 2 ^ (32 - bits)) by (apply Z.div_pos; lia).
  assert (last / 2 ^ (32 - bits) < 2 ^ bits).
  { apply Z.div_lt_upper_bound; [lia |]; rewrite <- Z.pow_add_r by lia;
    now replace (32 - bits + bits) with 32 by ring. }
  lia.
Qed.

(* Where the loop stops it would not go on: so bit i is below a step where steps of 2^i are too many. *)
Theorem too_many_stays : forall first last bits sh, 0 <= sh -> 0 <= bits ->
  too_many first last bits (sh + 1) -> too_many first last bits sh.
Proof.
  unfold too_many; intros first last bits sh Hsh Hbits H; by_steps sh.
  rewrite Z.pow_add_r in H by lia; change (2 ^ 1) with 2 in H.
  rewrite <- !Z.div_div in H by lia.
  pose proof (Z.pow_pos_nonneg 2 bits ltac:(lia) Hbits).
  pose proof (Z.div_mod (last / 2 ^ sh) 2 ltac:(lia)).
  pose proof (Z.mod_pos_bound (last / 2 ^ sh) 2 ltac:(lia)).
  pose proof (Z.div_mod (first / 2 ^ sh) 2 ltac:(lia)).
  pose proof (Z.mod_pos_bound (first / 2 ^ sh) 2 ltac:(lia)).
  lia.
Qed.

Lemma quotient_of_difference : forall first last k, 0 < k ->
  (last - first) / k = last / k - first / k \/ (last - first) / k = last / k - first / k - 1.
Proof.
  intros first last k Hk.
  pose proof (Z.div_mod first k ltac:(lia)); pose proof (Z.mod_pos_bound first k Hk).
  pose proof (Z.div_mod last k ltac:(lia)); pose proof (Z.mod_pos_bound last k Hk).
  pose proof (Z.div_mod (last - first) k ltac:(lia)); pose proof (Z.mod_pos_bound (last - first) k Hk).
  nia.
Qed.

(* below_o[i] of rtl/hi_z_word.sv, from the length of the range: a bit from i + bits on, or all bits of a
   bound and a borrow into bit i. *)
Definition below_step (first last bits i : Z) : bool :=
  let length := last - first in
  let borrow := xorb (xorb (Z.testbit length i) (Z.testbit last i)) (Z.testbit first i) in
  negb (Z.shiftr length (i + bits) =? 0) || ((Z.shiftr length i mod 2 ^ bits =? 2 ^ bits - 1) && borrow).

Theorem rtl_finds_the_shift : forall first last bits i, 0 <= i -> 0 < bits -> 0 <= first <= last ->
  (below_step first last bits i = true <-> too_many first last bits i).
Proof.
  intros first last bits i Hi Hbits Hrange; unfold below_step, too_many.
  assert (Hbit : forall v, Z.testbit v i = Z.odd (v / 2 ^ i)).
  { intro v; rewrite <- Z.shiftr_div_pow2 by exact Hi; rewrite <- Z.bit0_odd, Z.shiftr_spec by lia;
    f_equal; lia. }
  rewrite !Hbit; by_steps i.
  rewrite Z.pow_add_r by lia; rewrite <- Z.div_div by lia.
  pose proof (Z.pow_pos_nonneg 2 bits ltac:(lia) ltac:(lia)) as Hb.
  pose proof (quotient_of_difference first last (2 ^ i) ltac:(lia)) as Hd.
  assert (Hd0 : 0 <= (last - first) / 2 ^ i) by (apply Z.div_pos; lia).
  revert Hd Hd0; generalize (first / 2 ^ i) (last / 2 ^ i) ((last - first) / 2 ^ i); intros f l d Hd Hd0.
  assert (Hany : negb (d / 2 ^ bits =? 0) = (2 ^ bits <=? d)).
  { destruct (Z.leb_spec (2 ^ bits) d) as [Hle | Hlt].
    - apply negb_true_iff, Z.eqb_neq; pose proof (Z.div_le_mono (2 ^ bits) d (2 ^ bits) Hb Hle).
      rewrite Z.div_same in * by lia; lia.
    - apply negb_false_iff, Z.eqb_eq, Z.div_small; lia. }
  assert (Hborrow : xorb (xorb (Z.odd d) (Z.odd l)) (Z.odd f) = negb (d =? l - f)).
  { destruct Hd as [E | E]; rewrite E;
      destruct (Z.eqb_spec (l - f) (l - f)), (Z.eqb_spec (l - f - 1) (l - f)); try lia;
      rewrite ?Z.odd_sub; simpl; destruct (Z.odd l), (Z.odd f); reflexivity. }
  rewrite Hany, Hborrow.
  destruct (Z.leb_spec (2 ^ bits) d) as [Hle | Hlt]; simpl; [split; [lia | reflexivity] |].
  rewrite Z.mod_small by lia.
  destruct (Z.eqb_spec d (2 ^ bits - 1)), (Z.eqb_spec d (l - f)); simpl; split; try discriminate; lia.
Qed.

(* Entries are codes again: nothing overflows 32 bits. *)
Theorem entries_are_codes : forall first last sh least most i, 0 <= sh <= 32 ->
  0 <= least i < 2 ^ 32 -> 0 <= most i < 2 ^ 32 ->
  let w := rounded first last sh least most in 0 <= entry_least w i /\ entry_most w i < 2 ^ 32.
Proof.
  intros first last sh least most i Hsh Hl Hm w.
  destruct (rounding_changes_bits_below_a_step first last sh least most i ltac:(lia)) as [El Em].
  fold w in El, Em; rewrite El, Em; clear El Em.
  pose proof (Z.pow_pos_nonneg 2 sh ltac:(lia) ltac:(lia)) as Hp.
  pose proof (Z.mod_le (least i) (2 ^ sh) ltac:(lia) Hp).
  pose proof (Z.div_mod (most i) (2 ^ sh) ltac:(lia)).
  assert (Hsplit : 2 ^ 32 = 2 ^ (32 - sh) * 2 ^ sh) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  assert (most i / 2 ^ sh < 2 ^ (32 - sh)) by (apply Z.div_lt_upper_bound; lia).
  split; [lia |]; rewrite Hsplit; nia.
Qed.

Theorem cleared_is_exact : forall code i,
  entry_least (cleared code) i = code /\ entry_most (cleared code) i = code.
Proof. intros; unfold entry_least, entry_most, cleared; simpl; lia. Qed.

Theorem unknown_is_every_code : forall bits i, 0 <= bits <= 32 ->
  entry_least (unknown bits) i = 0 /\ entry_most (unknown bits) i = 2 ^ 32 - 1.
Proof.
  intros bits i Hbits; unfold entry_least, entry_most, unknown; cbn [base shift least_steps most_steps].
  by_steps (32 - bits); split; [ring |].
  assert (Hsplit : 2 ^ 32 = 2 ^ bits * 2 ^ (32 - bits)) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  replace ((2 ^ 32 - 1) / 2 ^ (32 - bits)) with (2 ^ bits - 1); [lia |].
  apply Z.div_unique with (2 ^ (32 - bits) - 1); lia.
Qed.

Print Assumptions rounding_changes_bits_below_a_step.
Print Assumptions rounding_is_outward.
Print Assumptions steps_fit_bits.
Print Assumptions shift_is_found.
Print Assumptions too_many_stays.
Print Assumptions rtl_finds_the_shift.
Print Assumptions entries_are_codes.
Print Assumptions cleared_is_exact.
Print Assumptions unknown_is_every_code.
