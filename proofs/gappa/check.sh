#!/usr/bin/env bash
# Proves each theorem with Gappa, and sees that its variants of must_fail.txt are refused. Where Coq and its
# library for Gappa are (coq, libcoq-gappa), Coq checks each proof and the lemmas of arguments.v.
# usage: check.sh BUILD_FOLDER
set -u
build=$(mkdir -p "${1:?usage: check.sh BUILD_FOLDER}" && cd "$1" && pwd) || exit
cd "$(dirname "$0")" || exit
bad=0
gappa=(gappa -Edichotomy=20) # deeper only takes longer to give up

# expect VERDICT TEXT COMMAND...: a line with the seconds that the command takes; one that fails counts.
expect() {
  local verdict=$1 text=$2 start
  shift 2
  start=$(date +%s%N)
  "$@" || { verdict="NOT $verdict" && bad=$((bad + 1)); }
  printf '%-24s %6.2f s  %s\n' "$verdict" "$(($(date +%s%N) - start))e-9" "$text"
}

# Gappa says nothing where all is proved; it warns of a rewriting that is not an identity.
proves() { [ -z "$("${gappa[@]}" "$1" 2>&1 || echo refused)" ]; }

# refuses THEOREM TEXT REPLACEMENT: the theorem has the text, and without it Gappa leaves a property open.
refuses() {
  local theorem
  theorem=$(<"$1.g")
  [[ $theorem == *"$2"* ]] &&
    "${gappa[@]}" <<< "${theorem//"$2"/"$3"}" 2>&1 |
    grep -q 'some properties were not satisfied\|no contradiction was found'
}

# Identities that Gappa takes as hypotheses become lemmas, by the tactic of algebra.v.
coq_accepts() {
  {
    cat algebra.v
    "${gappa[@]}" -Bcoq "$1.g" | sed -E 's/^Hypothesis (a[0-9]+ : .*)$/Lemma \1 algebra. Qed./'
  } > "$build/$1.v"
  ! grep -q Hypothesis "$build/$1.v" && coqc "$build/$1.v" > "$build/$1.log" 2>&1
}

for file in *.g; do
  expect proved "${file%.g}" proves "$file"
done
while IFS=';' read -r theorem text replacement why; do
  expect 'refused as it must be' "$theorem:$why" refuses "$theorem" "${text# }" "${replacement# }"
done < <(grep -v '^#' must_fail.txt)
expect 'witnesses hold' witnesses.py python3 witnesses.py
if command -v coqc > "$build/coqc"; then
  for file in *.g; do
    expect 'accepted by Coq' "${file%.g}" coq_accepts "${file%.g}"
  done
  expect 'accepted by Coq' arguments.v coqc -o "$build/arguments.vo" arguments.v
else
  echo 'no Coq here: proofs and arguments.v not checked by it'
fi
echo "$bad of these failed"
[ "$bad" = 0 ]
