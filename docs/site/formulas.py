# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as they are written in docs/theory, readable on a terminal, as TeX.

A formula is an indented line: `(4.1)  w = n.(u_b - u_a),   e = ...   in words`, the number at its beginning or its end.
Names of Greek letters and of functions, subscripts by `_`, powers by `^`, brackets and signs are those of the documents;
everything else that is longer than a symbol is a word. A slash between two factors without spaces is a fraction, with
spaces it stays a slash: how far its sides reach is then known to the reader only.
"""
import re

GREEK = {name: "\\" + name for name in (
    "alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi chi psi omega "
    "Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega").split()} | {"eps": "\\varepsilon"}
FUNCTIONS = {name: f"\\operatorname{{{name}}}" for name in (
    "div tr dev sym skw skew erf diag arg unit clamp").split()} | {
    name: "\\" + name for name in "ln exp cos sin tan sinh cosh coth tanh cot min max det".split()} | {
    "sum": "\\sum", "integral": "\\int", "int": "\\int", "grad": "\\nabla"}
# Symbols of more than one letter, and words that are too short to be taken for one.
SYMBOLS = {"up", "us", "Us", "ep", "KE", "CFL", "gm", "mv", "mc", "bC", "vbar", "qdot", "rate"}
WORDS = {"a", "at", "of", "if", "in", "to", "by", "on", "or", "is", "as", "it", "do", "no", "be", "from", "per", "the", "and"}
SIGNS = (("+-", "\\pm "), ("-+", "\\mp "), ("<=", "\\le "), (">=", "\\ge "), ("!=", "\\ne "), ("<-", "\\leftarrow "),
         ("->", "\\to "), ("+=", "\\mathrel{+}= "), ("-=", "\\mathrel{-}= "), ("...", "\\ldots "))
TOKEN = re.compile(r"\s+|\d+(?:\.\d+)?(?:e-?\d+)?|[A-Za-z]+(?:\d+[a-z]?(?![A-Za-z]))?|\+-|-\+|<=|>=|!=|<-|->|\+=|-=|\.\.\.|.")
OPENING, CLOSING = "([{", ")]}"
CALLED = {"ln", "exp", "erf", "max", "min"}  # also with other brackets than round ones
BRACES = {"{": "\\{", "}": "\\}"}
LABEL = re.compile(r"\((?P<label>(?:[A-Z]-?)?\d+(?:\.\d+)?[a-z]?|[A-Z]-[a-z]+)\)")


class NoFormula(Exception):
    """Say why a line is not understood."""


def symbol(name):
    """Return the TeX of one name, none for a word."""
    letters = re.match("[A-Za-z]*", name)[0]
    digits = name[len(letters):]  # "1a" as well
    below = f"_{{{digits}}}" if digits else ""
    if not letters.isalpha():
        return None
    if letters in GREEK:
        return GREEK[letters] + below
    if letters in FUNCTIONS and not digits:
        return FUNCTIONS[letters]
    if len(letters) == 1:
        return letters + below
    if letters[0] == "d" and (rest := symbol(name[1:])) and letters not in WORDS:
        return "d" + rest
    if letters in SYMBOLS:
        return f"\\mathit{{{letters}}}" + below
    return None


def index(name):
    """Return the TeX of a subscript: one or two letters are indices, more are a name."""
    if name in GREEK:
        return GREEK[name]
    return name if len(name) <= 2 or name.isdigit() else f"\\mathrm{{{name}}}"


class Line:
    """Read one line from left to right; each factor is one element of the result."""

    def __init__(self, text):
        self.tokens = TOKEN.findall(text)
        self.at = 0
        self.raised = 0  # depth of powers and subscripts, where fractions keep their slash

    def token(self, ahead=0):
        """Return a token from here on, empty behind the end."""
        return self.tokens[self.at + ahead] if self.at + ahead < len(self.tokens) else ""

    def take(self):
        """Return the token here and go on to the next."""
        self.at += 1
        return self.tokens[self.at - 1]

    def scripts(self):
        """Read what follows a factor, above and below it."""
        self.raised += 1
        result = self.marks()
        self.raised -= 1
        return result

    def marks(self):
        """Read what follows a factor without a space: subscripts, powers, stars, primes, tildes."""
        result, below, above = "", "", ""
        while self.token():
            if self.token() == "_":
                self.take()
                if self.token() in ("{", "("):
                    below += self.group()[1]
                elif re.match(r"\w", self.token()):
                    name = self.take()
                    while re.match("[A-Za-z0-9]", self.token()):  # 0H
                        name += self.take()
                    below += index(name)
                    while self.token() == "," and re.fullmatch(r"[a-z]{1,2}", self.token(1)) and self.token(2) != "(":
                        self.take()
                        below += "," + index(self.take())
                else:
                    raise NoFormula("a subscript without a name")
            elif self.token() == "^":
                self.take()
                if not self.token() or self.token().isspace():
                    result += "\0hat"
                    continue
                sign = self.take() if self.token() in "+-" else ""
                if self.token() == "{":
                    above += self.group()[1]
                elif self.token() == "(":
                    opening, inside, closing = self.group()
                    above += sign + (opening + inside + closing if sign else inside)
                else:
                    name = self.take()
                    above += sign + (symbol(name) or index(name))
                    if self.token() == "_" and name.isalpha():  # p^n_f
                        self.take()
                        above += f"_{{{index(self.take())}}}"
                    if sign and self.token() == "(":  # v^-2(a - b)
                        above += "".join(self.group())
                    if sign and self.token() == "/" and self.token(1).isdigit():  # v^-1/2
                        above += self.take() + self.take()
            elif self.token() == "*" and not above:
                self.take()
                result += "^{*}"
            elif self.token() == "'":
                primes = ""
                while self.token() == "'":
                    primes += self.take()
                result += primes
            elif self.token() == "~":
                self.take()
                result += "\0tilde"
            else:
                break
        return result, below, above

    def dressed(self, base):
        """Return a factor with the subscripts and powers that follow it."""
        marks, below, above = self.scripts()
        for accent in ("hat", "tilde"):
            if "\0" + accent in marks:
                marks = marks.replace("\0" + accent, "")
                base = f"\\{accent}{{{base}}}"
        text = base + (f"_{{{below}}}" if below else "")
        if marks and above:
            text = f"{{{text}{marks}}}"
        else:
            text += marks
        return text + (f"^{{{above}}}" if above else "")

    def group(self):
        """Read what brackets enclose. @returns the TeX of the opening bracket, of what is inside, and of the closing one"""
        opening = self.take()
        inside = self.sequence()
        if not self.token() or self.token() not in CLOSING:
            raise NoFormula(f"'{opening}' is not closed")
        closing = self.take()
        if (opening == "{") != (closing == "}"):
            raise NoFormula(f"'{opening}' is closed by '{closing}'")
        grown = ("\\left", "\\right") if "\\frac" in inside else ("", "")
        return grown[0] + BRACES.get(opening, opening), inside, grown[1] + BRACES.get(closing, closing)

    def is_word(self):
        """Return whether the name here is a word and not a symbol."""
        name, following = self.token(), self.token(1)
        if following and following in "_^*" or following == "'" and symbol(name):
            return False
        if name == "a":  # an article between words, else a symbol
            before = next((t for t in reversed(self.tokens[:self.at]) if not t.isspace()), "")
            after = next((t for t in self.tokens[self.at + 1:] if not t.isspace()), "")
            return (before.isalpha() and len(before) > 2 and symbol(before) is None) and \
                (after.isalpha() and after not in WORDS and symbol(after) is None)
        return name in WORDS or symbol(name) is None

    def words(self):
        """Read a run of words; signs between two of them belong to it."""
        text = self.take()
        while True:
            if self.token() == "'" and self.token(1) == "s":
                text += self.take() + self.take()
            gap = 0
            while self.token(gap) and (self.token(gap).isspace() and len(self.token(gap)) == 1 or self.token(gap) in (",", ":", ";", "-", "'", ".")):
                gap += 1
            here = self.at
            self.at += gap
            goes_on = gap and re.match(r"[A-Za-z]", self.token()) and self.is_word() and len(self.token()) > 1
            self.at = here
            if not goes_on:
                if self.token() in (":", ";"):
                    text += self.take()
                return f"\\text{{{text}}}"
            text += "".join(self.take() for _ in range(gap + 1))

    def is_cross(self):
        """Return whether the name here is the cross of a product: an x, in spaces, between two letters or two numbers."""
        around = self.tokens[max(self.at - 2, 0):self.at] + self.tokens[self.at + 1:self.at + 3]
        return self.token() == "x" and len(around) == 4 and around[1] == around[2] == " " and any(
            all(re.fullmatch(kind, around[i]) for i in (0, 3)) for kind in ("[A-Za-z]", r"\d+(\.\d+)?"))

    def factor(self):
        """Read one factor with all that is attached to it."""
        token = self.token()
        if self.is_cross():
            self.take()
            return "\\times"
        if token[:1].isalpha():
            if token == "sqrt" and self.token(1) in ("(", "["):
                self.take()
                return f"\\sqrt{{{self.group()[1]}}}"
            if self.is_word():
                return self.words()
            name = self.take()
            base = self.dressed(symbol(name) or f"\\mathrm{{{name}}}")
            if self.token() == "(" and name not in ("sum", "integral", "grad") or name in CALLED and self.token() in ("[", "{"):
                base += self.dressed("".join(self.group()))
            return base
        if token in OPENING:
            return self.dressed("".join(self.group()))
        if token == "|":
            return self.bar()
        if re.match(r"\d", token):
            number = self.take()
            return self.dressed(number.replace("e", "\\cdot 10^{") + "}" if "e" in number else number)
        return None

    def bar(self):
        """Read a norm, |x|."""
        end = next((i for i in range(self.at + 1, len(self.tokens)) if self.tokens[i] == "|"), None)
        if end is None:
            raise NoFormula("'|' is not closed")
        inner = Line("")
        inner.tokens = self.tokens[self.at + 1:end]
        text = inner.sequence()
        self.at = end + 1
        return self.dressed(f"\\lvert {text} \\rvert")

    def sequence(self):
        """Read factors and signs up to a closing bracket."""
        parts = []
        while self.token() and self.token() not in CLOSING:
            token = self.token()
            if token.isspace():
                self.take()
                parts.append("\\quad " if len(token) > 1 else " ")
            elif (made := self.factor()) is not None:
                parts.append(made)
            elif token == "/" and self.is_fraction(parts):
                self.take()
                below = self.factor()
                above = parts.pop()
                parts.append(f"\\frac{{{self.bare(above)}}}{{{self.bare(below)}}}")
            else:
                parts.append(self.sign())
        return "".join(parts)

    def is_fraction(self, parts):
        """Return whether the slash here stands between two factors. @param parts  what is read so far"""
        before = parts[-1] if parts else " "
        after = self.token(1)
        if self.raised or not before.strip() or before in ("d", "+", "-", "\\quad ") or before.startswith("\\text"):
            return False
        if not re.match(r"[\w(\[{|]", after) or after == "d":
            return False
        return not (after.isalpha() and (after in WORDS or symbol(after) is None))

    @staticmethod
    def bare(text):
        """Return a side of a fraction without the brackets around all of it."""
        for opening, closing in (("\\left(", "\\right)"), ("\\left[", "\\right]"), ("(", ")"), ("[", "]")):
            if text.startswith(opening) and text.endswith(closing):
                depth = 0
                for i in range(len(text)):
                    depth += text.startswith(opening, i) - text.startswith(closing, i)
                    if depth == 0:
                        return text[len(opening):-len(closing)] if i >= len(text) - len(closing) else text
        return text

    def sign(self):
        """Read a sign, or text between backquotes."""
        token = self.token()
        before = self.tokens[self.at - 1] if self.at else " "
        after = self.token(1) or " "
        self.take()
        for name, tex in SIGNS:
            if token == name:
                return tex
        if token == "<":
            return "\\langle " if not after.isspace() else "< "
        if token == ">":
            return self.dressed("\\rangle ") if not before.isspace() else "> "
        if token == ".":
            if after.isspace() and not before.isspace():
                return "."
            return "\\cdot "
        if token == "*":
            return "{}^{*}"
        if token == "~":
            return "\\sim "
        if token in "+-=/,;:!":
            return token
        if token == "`":
            end = next((i for i in range(self.at, len(self.tokens)) if self.tokens[i] == "`"), None)
            if end is None:
                raise NoFormula("'`' is not closed")
            text = "".join(self.tokens[self.at:end]).replace("_", "\\_")
            self.at = end + 1
            return f"\\texttt{{{text}}}"
        raise NoFormula(f"unknown sign '{token}'")


def tex_of(text):
    """Return the TeX of a formula without its number. @raises NoFormula"""
    line = Line(text)
    result = line.sequence()
    if line.token():
        raise NoFormula(f"'{line.token()}' was not opened")
    # Words are parted from symbols.
    result = re.sub(" +", " ", result)
    result = re.sub(r"(?<=[^\s{]) *(\\text\{)", r"\\ \1", result)
    return re.sub(r"(\\text\{[^}]*\}) +(?=\S)", r"\1\\ ", result)


def split(line):
    """Return (number, formula) of a line; the number is none where a line has none."""
    text = line.strip()
    if (found := LABEL.match(text)) and text[found.end():found.end() + 2].isspace():
        return found["label"], text[found.end():].strip()
    found = re.search(r"\s{2,}" + LABEL.pattern + "$", text)
    return (found["label"], text[:found.start()].strip()) if found else (None, text)


def rows(lines):
    """Return (number, indent, formula, TeX) of each line of a block.
    @raises NoFormula if one of them is no formula: the block is then text"""
    result = []
    base = min(len(line) - len(line.lstrip()) for line in lines)
    for line in lines:
        number, text = split(line)
        indent = len(line) - len(line.lstrip()) - base
        result.append((number, indent, text, tex_of(text)))
    if not any(number or re.search("[=<>]", text) for number, _, text, _ in result):
        raise NoFormula("no relation")
    return result
