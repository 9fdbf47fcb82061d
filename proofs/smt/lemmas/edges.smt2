; The edge equations that setup_edges.sv makes are those of model/halfspace/units/setup.cpp. Over all integers.
; Vertices (x0, y0) ... (x2, y2), in the order in which setup has turned them; a sample (x, y).
(set-logic QF_NIA)
(declare-const x0 Int)
(declare-const y0 Int)
(declare-const x1 Int)
(declare-const y1 Int)
(declare-const x2 Int)
(declare-const y2 Int)
(declare-const x Int)
(declare-const y Int)

; setup.cpp: edge i from vertex i + 1 to vertex i + 2, E from the vertex where it starts.
(define-fun a0 () Int (- y1 y2))
(define-fun b0 () Int (- x2 x1))
(define-fun a1 () Int (- y2 y0))
(define-fun b1 () Int (- x0 x2))
(define-fun a2 () Int (- y0 y1))
(define-fun b2 () Int (- x1 x0))
(define-fun e0 () Int (+ (* a0 (- x x1)) (* b0 (- y y1))))
(define-fun e1 () Int (+ (* a1 (- x x2)) (* b1 (- y y2))))
(define-fun e2 () Int (+ (* a2 (- x x0)) (* b2 (- y y0))))

; setup_cull.sv and twice_signed_area().
(define-fun area2 () Int (- (* (- x1 x0) (- y2 y0)) (* (- x2 x0) (- y1 y0))))

; setup_edges.sv: edges 1 and 2 from vertex 0, edge 0 from the area.
(define-fun from_vertex_0 ((a Int) (b Int)) Int (+ (* a (- x x0)) (* b (- y y0))))
(define-fun property_edge_0 () Bool (= e0 (- area2 (from_vertex_0 a1 b1) (from_vertex_0 a2 b2))))
(define-fun property_edge_1 () Bool (= e1 (from_vertex_0 a1 b1)))
(define-fun property_edge_2 () Bool (= e2 (from_vertex_0 a2 b2)))
