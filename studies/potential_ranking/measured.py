# SPDX-License-Identifier: BSD-3-Clause
"""The metals of the ranking with their potentials, and what their potentials are compared with: tables of eos/data."""
import csv
import dataclasses
import pathlib
import tomllib

from studies.potential_ranking import rule

DATA = pathlib.Path(__file__).resolve().parents[2] / "eos/data"
AVOGADRO = 0.602214076  # cm^3/mol per cubic angstrom
HIGHEST_OF_A_LINE = 200.0  # GPa: how far a published line without a stated range is followed


@dataclasses.dataclass
class Metal:
    """Symbol, crystal, row of Steinberg's table, tables of points, and plans (cases/md/PLAN.toml) with their potentials."""

    symbol: str
    structure: str
    row: str
    potentials: dict
    hugoniot: str = ""
    isotherm: str = ""
    melting_point: float = 0.0


UNIVERSAL = "Foiles et al. 1986, universal 3"
ZHOU = "Zhou et al. 2004"
METALS = {
    "copper": Metal("Cu", "fcc", "CopperOFHC",
                    {"copper_mishin_short": "Mishin et al. 2001", "copper_u3_short": UNIVERSAL,
                     "copper_u6_short": "Adams et al. 1989, universal 6", "copper_zhou_short": ZHOU,
                     "copper_snap_short": "Li et al. 2018, SNAP (KIM)"},
                    hugoniot="cu_hugoniot_marsh1980", isotherm="cu_isotherm_298K_dewaele2004"),
    "aluminium": Metal("Al", "fcc", "Aluminum1100-O",
                       {"aluminium_zhakhovsky_short": "Zhakhovsky et al. 2009 (KIM)", "aluminium_winey_short": "Winey et al. 2010 (KIM)",
                        "aluminium_voter_short": "Voter, Chen 1987", "aluminium_zhou_short": ZHOU,
                        "aluminium_mendelev_short": "Mendelev et al. 2008"},
                       isotherm="al_isotherm_298K_dewaele2004"),
    "nickel": Metal("Ni", "fcc", "Nickel",
                    {"nickel_u3_short": UNIVERSAL, "nickel_zhou_short": ZHOU, "nickel_mishin_short": "Mishin et al. 1999 (KIM)"},
                    hugoniot="ni_hugoniot_marsh1980"),
    "lead": Metal("Pb", "fcc", "Lead", {"lead_zhou_short": ZHOU, "lead_landa_short": "Landa et al. 2000 (KIM)",
                                        "lead_hoyt_short": "Hoyt et al. 2003 (KIM)"}),
    "tantalum": Metal("Ta", "bcc", "Tantalum",
                      {"tantalum_ravelo_short": "Ravelo et al. 2013 (KIM)", "tantalum_zhou_short": ZHOU,
                       "tantalum_derlet_short": "Derlet et al. 2007 (KIM)", "tantalum_snap_short": "Thompson et al. 2015, SNAP (KIM)"},
                      isotherm="ta_isotherm_298K_dewaele2004"),
    "tungsten": Metal("W", "bcc", "Tungsten", {"tungsten_zhou_short": ZHOU, "tungsten_han_short": "Han et al. 2003 (KIM)"},
                      isotherm="w_isotherm_298K_dewaele2004"),
    "molybdenum": Metal("Mo", "bcc", "Molybdenum",
                        {"molybdenum_zhou_short": ZHOU, "molybdenum_derlet_short": "Derlet et al. 2007 (KIM)",
                         "molybdenum_snap_short": "Chen et al. 2017, SNAP (KIM)"}),
    "silver": Metal("Ag", "fcc", "Silver", {"silver_u3_short": UNIVERSAL, "silver_zhou_short": ZHOU,
                                            "silver_williams_short": "Williams et al. 2006 (KIM)"}),
    "gold": Metal("Au", "fcc", "Gold", {"gold_u3_short": UNIVERSAL, "gold_zhou_short": ZHOU,
                                        "gold_zhakhovsky_short": "Zhakhovsky et al. 2009 (KIM)",
                                        "gold_grochola_short": "Grochola et al. 2005 (KIM)"}),
    "platinum": Metal("Pt", "fcc", "Platinum", {"platinum_u3_short": UNIVERSAL, "platinum_zhou_short": ZHOU}),
}


def rows_of(name):
    """Rows of a table of eos/data without its comments."""
    with (DATA / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def steinberg(row):
    """Density (g/cm^3), C (km/s), S1, S2, S3 and atomic weight of a row of Steinberg's report."""
    found = next(one for one in rows_of("metals_steinberg1996") if one["material"] == row)
    return tuple(float(found[key]) for key in ("rho0_g_cm3", "C_km_s", "S1", "S2", "S3", "A_g_mol"))


def melting_point(symbol):
    """Measured melting point (K) of elements.toml."""
    tables = tomllib.loads((DATA / "elements.toml").read_text(encoding="utf-8"))
    element = next(one for one in tables["element"] if one["symbol"] == symbol)
    return float(next(one for one in element["constant"] if one["parameter"] == "melting_point")["value"].split()[0])


def solve(matrix, right):
    """Solution of a small linear system, by elimination with pivots."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda k, i=i: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(len(rows)):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def least_squares(functions, x, y):
    """Coefficients of the sum of functions that is nearest to the points."""
    columns = [[function(value) for value in x] for function in functions]
    matrix = [[sum(a * b for a, b in zip(one, other)) for other in columns] for one in columns]
    return solve(matrix, [sum(a * b for a, b in zip(one, y)) for one in columns])


def birch_residual(volume, volumes, pressures):
    """Sum of squares of a curve of Birch and Murnaghan, of third order, with this V0."""
    functions = (lambda v: rule.birch_factor(v / volume), lambda v: rule.birch_factor(v / volume) * rule.strain(v / volume))
    weights = least_squares(functions, volumes, pressures)
    return sum((sum(w * f(v) for w, f in zip(weights, functions)) - p) ** 2 for v, p in zip(volumes, pressures))


def birch_volume(volumes, pressures):
    """V0 of the Birch-Murnaghan curve of third order through the points of an isotherm."""
    low, high = 0.98 * max(volumes), 1.1 * max(volumes)
    for _ in range(60):  # the residual has one minimum: thirds
        one, other = low + (high - low) / 3.0, high - (high - low) / 3.0
        if birch_residual(one, volumes, pressures) < birch_residual(other, volumes, pressures):
            high = other
        else:
            low = one
    return 0.5 * (low + high)


class Reference:
    """What the potentials of a metal are compared with: Us(up), an isotherm where there is one, density, window."""

    def __init__(self, metal):
        metal.melting_point = melting_point(metal.symbol)
        density, self.c, *self.s, weight = steinberg(metal.row)
        self.quadratic = None
        self.up_end = 10.0
        self.text = "Shocks: Steinberg 1996"
        if metal.hugoniot:
            rows = [row for row in rows_of(metal.hugoniot) if float(row["up_km_s"]) > 0.0]
            up = [float(row["up_km_s"]) for row in rows]
            self.quadratic = least_squares([lambda x, n=n: x**n for n in range(3)], up, [float(row["us_km_s"]) for row in rows])
            self.up_end = max(up)
            self.text = f"Shocks: `{metal.hugoniot}`, {len(up)} points"
        self.isotherm = None
        if metal.isotherm:
            rows = rows_of(metal.isotherm)
            volumes = [float(row["atomic_volume_A3"]) for row in rows]
            pressures = [float(row["P_revised_ruby_GPa"]) for row in rows]
            volume = birch_volume(volumes, pressures)
            density = weight / (volume * AVOGADRO)
            self.isotherm = sorted((p, v / volume) for v, p in zip(volumes, pressures))
            self.text += f"; isotherm: `{metal.isotherm}`, V0 = {volume:.3f} cubic angstrom"
        self.density = density
        self.window = rule.window_of_velocities(density, self.velocity, self.up_end)
        self.pressures = tuple(rule.shock_pressure(density, self.velocity(up), up) for up in self.window)

    def velocity(self, up):
        """Shock velocity (km/s) of the reference at a particle velocity."""
        if self.quadratic:
            return sum(value * up**n for n, value in enumerate(self.quadratic))
        us = self.c + self.s[0] * up
        for _ in range(50):  # S2 and S3 multiply (up/Us) up and (up/Us)^2 up
            us = self.c + up * (self.s[0] + self.s[1] * up / us + self.s[2] * (up / us) ** 2)
        return us

    def isotherm_ratios(self, lowest, highest):
        """V/V0 of the measured points between two pressures."""
        return [ratio for pressure, ratio in self.isotherm if lowest <= pressure <= highest]

    def isotherm_pressure(self, ratio):
        return next(pressure for pressure, one in self.isotherm if one == ratio)

    def valid_on_hugoniot(self, curve, ends_by_itself):
        """Pressure up to which the simulated shocks stay within their bound, and whether that may not be the end."""
        top = max(up for up in rule.even(0.0, self.up_end, 2001)
                  if self.quadratic or rule.shock_pressure(self.density, self.velocity(up), up) <= HIGHEST_OF_A_LINE)
        places = rule.even(self.window[0], top, 401)
        last, open_end = rule.valid_to(curve, self.velocity, places, rule.BOUNDS["points"], ends_by_itself)
        return (0.0 if last is None else rule.shock_pressure(self.density, self.velocity(last), last)), open_end

    def valid_on_isotherm(self, curve, ends_by_itself):
        ratios = self.isotherm_ratios(rule.LOWEST, float("inf"))
        last, open_end = rule.valid_to(curve, self.isotherm_pressure, ratios, rule.BOUNDS["isotherm"], ends_by_itself)
        return (0.0 if last is None else self.isotherm_pressure(last)), open_end
