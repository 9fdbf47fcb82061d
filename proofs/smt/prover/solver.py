"""The two solvers behind one face: SMT-LIB goes in, "sat", "unsat" or "unknown" comes out."""

import bitwuzla
import cvc5


class Bitwuzla:
    def __init__(self, limit, logic="QF_UFBV"):
        self.manager = bitwuzla.TermManager()
        options = bitwuzla.Options()
        options.set(bitwuzla.Option.PRODUCE_MODELS, True)
        options.set(bitwuzla.Option.TIME_LIMIT_PER, int(limit * 1000))
        self.parser = bitwuzla.Parser(self.manager, options)
        self.parser.parse(f"(set-logic {logic})", True, False)

    def add(self, lines):
        if lines:
            self.parser.parse("\n".join(lines), True, False)

    def check(self, *terms):
        solver = self.parser.bitwuzla()
        return str(solver.check_sat(*[self.parser.parse_term(term) for term in terms])).lower().split(".")[-1]

    def value(self, term):
        return str(self.parser.bitwuzla().get_value(self.parser.parse_term(term)))


class Cvc5:
    def __init__(self, limit, logic="QF_UFBV"):
        self.solver = cvc5.Solver()
        self.solver.setOption("incremental", "true")
        self.solver.setOption("produce-models", "true")
        self.solver.setOption("tlimit-per", str(int(limit * 1000)))
        self.solver.setLogic(logic)
        self.symbols = cvc5.SymbolManager(self.solver.getTermManager())
        self.parser = cvc5.InputParser(self.solver, self.symbols)

    def _parser(self, text):
        self.parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, text, "proof")
        return self.parser

    def add(self, lines):
        parser = self._parser("\n".join(lines))
        while not (command := parser.nextCommand()).isNull():
            command.invoke(self.solver, self.symbols)

    def check(self, *terms):
        return str(self.solver.checkSatAssuming(*[self._term(term) for term in terms])).split()[0]

    def value(self, term):
        return str(self.solver.getValue(self._term(term)))

    def _term(self, text):
        return self._parser(text).nextTerm()


SOLVERS = {"bitwuzla": Bitwuzla, "cvc5": Cvc5}
