; What the proofs over bits leave to arithmetic. Over all integers.
(set-logic QF_NIA)

; block_edge.sv and tile_edge.sv: the way to a corner of a tile of T pixels.
(declare-const T Int)
(declare-const across Int)
(declare-const down Int)
(define-fun property_corner_is_by_axis () Bool
  (= (- (* T (+ across down)) (+ across down)) (+ (* (- T 1) across) (* (- T 1) down))))

; setup: the product of two numbers of 25 signed bits, the widest that steps are.
(declare-const a Int)
(declare-const b Int)
(define-fun step ((c Int)) Bool (and (<= (- 16777216) c) (<= c 16777215)))
(assert (and (step a) (step b)))
; The least product is above - most, the most is it.
(define-fun most () Int 281474976710656)
(define-fun property_product_fits () Bool (and (<= (- most) (* a b)) (<= (* a b) most)))
