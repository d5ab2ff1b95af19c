# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""The sections of the page that bench/thesis.py makes: tables, charts and pictures of what was measured."""
import os
import tomllib

import thesis_numbers as thesis
from thesis_measure import CORES, ROOT

RAY_KINDS = ("primary", "extension", "shadow")
BLOCKS = ("generate", "extend", "shade", "connect", "finalize")
TABLE2 = "Table 2 and Figure 16: what the port shares"
COSTS = "Equations 3 to 8: what a port costs"
FEWEST_PORTS = 8  # that porttool fits equation 8 to


def number(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def degree_of(block):
    """As `porttool report` has it: 1.00 is a port that costs nothing at all."""
    degree = block["degree_of_portability"]
    if degree is None or degree["loc"] is None:
        return "-"
    return "0.99" if 0.99 < degree["loc"] < 1 else number(degree["loc"], 2)


def add_machine(page, take, settings, left_out, scenes):
    info = take.take("info", [take.program, "info", "--format", "json"]) or {"cores": []}
    devices = {core["id"]: core.get("device") or core.get("reason") for core in info["cores"]}
    section = page.section("What was run, and on what")
    section.table(["core", "device"], [[core, devices.get(core, "-")] for core in CORES])
    section.say(f"Pictures of {settings['size']}, up to {settings['counts'][-1]} samples a pixel. Times are of this machine in "
                f"the state in which it was (load {os.getloadavg()[2]:.0f} on {os.cpu_count()} processors when the page was made); "
                "whoever compares times should leave it alone meanwhile.")
    if any(word in (devices.get("source") or "").lower() for word in ("llvmpipe", "lavapipe", "swiftshader")):
        section.say("This machine has no GPU: the source core runs in software here, and its times say nothing of the thesis's "
                    "GPU. `bench/thesis.py --self-test FILE` on a machine with one makes a file that `--with FILE` adds.")
    section.say(f"Measuring took {take.seconds / 60:.1f} minutes, and {take.processor_seconds / 60:.1f} minutes of processor "
                "time, of which an idle machine needs at least its share a processor.")
    ours, others = ([scene.name for scene in scenes if scene.ours == own] for own in (True, False))
    section.say("Scenes of our own, by rising size: " + ", ".join(ours) + ("; and " + ", ".join(others) if others else "") + ".")
    for reason in left_out:
        section.quote(f"Left out: {reason}.")


def add_table1(page, scene, found):
    section = page.section(f"Table 1: pictures of the two cores, {scene.name}")
    rows = []
    for spp, row in found["rows"].items():
        cells = [spp]
        for kind in ("same", "own", "itself"):
            cells += [number(row[kind]["ssim"], 4), number(row[kind]["rmse"], 2)]
        for theirs in (thesis.TABLE1["Sponza"], thesis.TABLE1["Pica Pica"]):
            ssim, rmse = theirs.get(spp, (None, None))
            cells += [number(ssim), number(rmse, 1)]
        rows.append(cells)
    section.table(["samples", "same seed: SSIM", "RMSE", "a seed each: SSIM", "RMSE", "target against itself: SSIM", "RMSE",
                   "thesis, Sponza: SSIM", "RMSE", "thesis, Pica Pica: SSIM", "RMSE"], rows)
    section.say("RMSE of levels from 0 to 255. \"A seed each\" is the source core against the target core with independent noise; "
                "\"target against itself\" is that very picture against the target core with the first seed. Where these two "
                "agree, all that differs is noise. The thesis's own figures stop falling at 28.1 and 31.9: what noise cannot do.")
    bias = found["bias"]
    if bias is not None:
        section.table(["batches with seeds of their own", "verdict", "p", "tiles that differ", "mean difference", "standard error",
                       "would be found from"],
                      [["bias", bias["verdict"], f"{bias['p_value']:.2g}", f"{bias['tiles_different']} of {bias['tiles']}",
                        f"{bias['mean_difference']:+.2e}", f"{bias['standard_error']:.1e}",
                        "-" if bias["detectable"] is None else f"{100 * bias['detectable']:.2g} %"]])


def add_pictures(page, scene, counts, pictures):
    section = page.section(f"Figures 8 to 11: {scene.name}")
    for name, what in (("source", "source core"), ("target", "target core"), ("difference", "difference, times 16")):
        section.picture(pictures / scene.name / f"{name}_{counts[-1]}spp.png", f"{what}, {counts[-1]} samples")
    section.picture(pictures / f"{scene.name}_bias/bias.png", "where the means differ, if they do")


def add_speed(page, scene, series, charts):
    section = page.section(f"Figures 12 to 15: speed, {scene.name}")

    def rows_of(cells):
        return [[name, *cells(bench)] for name, bench in series.items()]

    def draw(figure, caption, cells, parts=("",)):
        section.chart(charts / f"{scene.name}_figure_{figure}.svg", f"Figure {figure}, {scene.name}: {caption}",
                      {name: cells(bench) for name, bench in series.items()}, parts)
    section.table(["series", "frames a second (Fig. 12)", "ms a frame", "million rays a second (Fig. 15)", "tracing alone"], rows_of(
        lambda b: [number(1000 / b["ms_per_frame"]["total"], 2), number(b["ms_per_frame"]["total"], 2),
                   number(b["mrays_per_s"]["total"], 2), number(b["mrays_per_s"]["trace"], 2)]) + thesis.SPEED)
    section.say(f"The thesis's CPU core ran on {thesis.CPU}, and its frame has {thesis.RAYS[0][4]:,} rays; ours runs on all processors, "
                "and the next table has the rays of its frame. Rays a second compare better than frames.")
    draw(12, "frames a second", lambda b: [1000 / b["ms_per_frame"]["total"]])
    section.table(["rays of a frame (Fig. 13)", "primary", "extension", "shadow", "total", "primary and extension, % of all"],
                  rows_of(lambda b: [*(b["rays"][kind] for kind in (*RAY_KINDS, "total")),
                                     number(100 * (b["rays"]["primary"] + b["rays"]["extension"]) / max(b["rays"]["total"], 1), 1)])
                  + thesis.RAYS)
    draw(13, "rays of a frame by kind", lambda b: [b["rays"][kind] for kind in RAY_KINDS], RAY_KINDS)
    section.table(["time of a frame, % (Fig. 14)", *BLOCKS, "between them", "tracing"],
                  rows_of(lambda b: [number(share, 1) for share in time_shares(b)]) + thesis.TIME)
    draw(14, "time of a frame by block, %", lambda b: time_shares(b)[:len(BLOCKS)], BLOCKS)
    draw(15, "million rays a second", lambda b: [b["mrays_per_s"]["total"]])


def time_shares(bench):
    ms = bench["ms_per_frame"]
    total = max(ms["total"], 1e-9)
    shares = [100 * ms[block] / total for block in BLOCKS]
    return [*shares, 100 - sum(shares), shares[1] + shares[3]]


def whole_core(report):
    return {block["name"]: block for block in report["blocks"]}.get("Render core", report["totals"])


def percent_of(lines, whole):
    return 100 * lines / max(whole, 1)


def add_table2(page, report, charts):
    section = page.section(TABLE2)
    if report is None:
        section.say("Left out: there is no report of porttool; why, the first section says.")
        return
    whole, rows, shares = whole_core(report), [], {}
    for block in report["blocks"]:
        theirs = thesis.TABLE2.get(block["name"], ("-",) * 7)
        cells = [block["name"]]
        for side in ("target", "source"):
            cells += [block[f"{side}_lines"], block[f"shared_{side}"], number(block[f"moss_percent_{side}"], 0),
                      number(percent_of(block[f"{side}_lines"], whole[f"{side}_lines"]), 1),
                      number(percent_of(block[f"shared_{side}"], whole[f"{side}_lines"]), 1)]
            shares[f"{block['name']}, {'CPU' if side == 'target' else 'GPU'}"] = [
                percent_of(block[f"shared_{side}"], whole[f"{side}_lines"]),
                percent_of(block[f"{side}_lines"] - block[f"shared_{side}"], whole[f"{side}_lines"])]
        rows.append([*cells, degree_of(block), *theirs])
    ours = ("lines", "shared", "Moss %", "lines, % of the core", "shared, % of the core")
    section.table(["block", *(f"{core} {what}" for core in ("CPU", "GPU") for what in ours), "degree of portability",
                   "thesis: CPU lines", "shared", "Moss %", "GPU lines", "shared", "Moss %", "degree of portability"], rows)
    section.say("The render core's lines are host code for the most part, whose changes the count of kernel files at the head of this "
                "page does not see; `bench/thesis.py --code PAGE` counts all lines of this section and of the next anew, and so does "
                "docs/portability-report.md.")
    section.chart(charts / "figure_16.svg", "Figure 16: lines, % of the whole core of their side", shares, ("shared", "not shared"))
    section.chart(charts / "degree.svg", "degree of portability", {b["name"]: [b["degree_of_portability"]["loc"]]
                                                                   for b in report["blocks"] if b["degree_of_portability"]})


def add_picture_equations(page, scene, pictures):
    section = page.section("Equations 3 to 8: pictures")
    rows = []
    if pictures is not None:
        spp, row = list(pictures["rows"].items())[-1]
        rows = [[f"RMSE, {scene.name}, {spp} samples", "sqrt(mean (a - b)^2)", number(row["same"]["rmse"], 2),
                 "31.9 (Pica Pica, 1024)"],
                [f"SSIM, {scene.name}, {spp} samples",
                 "(2 m_a m_b + c_1)(2 s_ab + c_2) / ((m_a^2 + m_b^2 + c_1)(s_a^2 + s_b^2 + c_2))",
                 number(row["same"]["ssim"], 4), "0.878 (Pica Pica, 1024)"]]
    section.table(["quantity", "formula", "here", "thesis"], rows)
    section.say("The project holds no copy of the thesis: which formula has which of its numbers is known of equation 8 alone "
                "(3.1.3). These are the quantities of its tables; docs/metrics.md has each formula in full, with its source.")


def add_cost_equations(page, report, take):
    section = page.section(COSTS)
    rows = []
    for block in (report or {"blocks": []})["blocks"]:
        theirs = thesis.TABLE2.get(block["name"])
        if not theirs:
            continue
        lines, shared = block["target_lines"], block["shared_target"]
        rows += [[f"C_port, {block['name']}", "lines not shared", lines - shared, theirs[0] - theirs[1]],
                 [f"C_redevelop, {block['name']}", "lines", lines, theirs[0]],
                 [f"degree of portability, {block['name']}", "1 - C_port / C_redevelop", degree_of(block), theirs[-1]]]
    section.table(["quantity", "formula", "here", "thesis"], rows)
    add_law_of_ports(section, take)


def law_of_ports(own, timed, take):
    """The answer of `porttool effort` about the last port of our own, and why there is none."""
    if len(timed) < FEWEST_PORTS or not own:
        return None, (f"{len(timed)} ports are recorded with lines and hours, {len(own)} of them this project's own; a fit needs "
                      f"{FEWEST_PORTS}, and one of its own to ask about")
    answer = take.effort(own[-1]["from"], own[-1]["to"])
    law = answer and answer["predicted_hours_by_law"]
    return law, "" if law else "porttool effort gave no answer here"


def add_law_of_ports(section, take):
    """Equation 8, fitted to the ports that portmap.toml records with lines and hours; asked of the last of our own."""
    timed = [record for record in tomllib.loads((ROOT / "portmap.toml").read_text()).get("effort", [])
             if "lines" in record and "port" in record]
    own = [record for record in timed if not record.get("mined")]
    law, reason = law_of_ports(own, timed, take)
    inputs = law["inputs"] if law else {}
    rows = [["C, hours", "-", "-"]]
    if law:
        rows = [["C, hours", f"{inputs['C']:.3g}", f"times or by {inputs['standard error of C (factor)']:.2g}"]]
    rows += [[name, f"{inputs[name]:.2f}", f"{inputs['standard error of ' + name]:.2f}"] if name in inputs else [name, "-", "-"]
             for name in ("beta", "beta_p", "beta_H", "beta_E")]
    section.table(["equation 8: Y = C 10^(beta_p alpha_p) 10^(beta_H alpha_H) 10^(beta_E alpha_E) X^beta", "fitted", "standard error"],
                  rows)
    if not law:
        section.say(f"Equation 8 is not fitted: {reason}.")
        return
    section.say(f"Hours Y of a port of X lines, fitted in logarithms to {inputs['ports recorded']:.0f} ports, of them "
                f"{inputs['of them mined']:.0f} mined from another project's public history by bench/mined_ports.py, with the hours "
                "between their authors' commits for want of better; an impediment that is the same in all is a part of C. The ports "
                f"scatter around it by a factor of {inputs['scatter (factor)']:.2g}. It makes \"{own[-1]['what']}\" "
                f"({inputs['lines']:.0f} lines, itself one of these ports) {law['value']:.2g} hours ({law['low']:.2g} to "
                f"{law['high']:.2g}, 95 %); it took {sum(own[-1]['port'].values()):.2g}.")


def add_other_machines(page, machines):
    for title, rows, words in machines:
        section = page.section(title, quoted=True)
        section.table(["series", "frames a second", "ms a frame", "million rays a second", "tracing alone", "tracing, % of a frame"],
                      rows + [[*speed, share[-1]] for speed, share in zip(thesis.SPEED, thesis.TIME)])
        section.say(words)
