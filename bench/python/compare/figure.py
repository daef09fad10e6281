"""Bars of nanoseconds a pose on a logarithmic axis, with the arithmetic floor."""

from matplotlib.ticker import FuncFormatter

from ninedof.plot import style

OURS, THEIRS = style.EXTERNAL, style.PLATFORM


def bar(axes, y, line, colour):
    axes.barh(y, line.median, height=0.62, color=colour, left=0.0)
    axes.plot([line.median, line.worst], [y, y], color=style.INK, linewidth=0.9)
    axes.plot(line.worst, y, marker="|", color=style.INK, markersize=6)


def words(nanoseconds):
    value, unit = (nanoseconds / 1e3, "µs") if nanoseconds >= 1e3 else (nanoseconds, "ns")
    return f"{value:.0f} {unit}" if value >= 10.0 or value == round(value) else f"{value:.1f} {unit}"


def draw(results, path):
    lines = [line for line in results.lines if not line.missing]
    floors = results.floors()
    with style.settings():
        figure = style.new_figure(7.6, 1.35 + 0.30 * len(lines))
        axes = figure.add_subplot()
        axes.set_xscale("log")
        for y, line in enumerate(lines):
            ours = line.method.module == "with_ninedof"
            bar(axes, y, line, OURS if ours else THEIRS)
            text = words(line.median) if ours else f"{words(line.median)}   {results.ratio(line):.0f} × ours"
            axes.annotate(
                text,
                (line.worst, y),
                xytext=(6, 0),
                textcoords="offset points",
                va="center",
                fontsize=style.SMALL_SIZE,
            )
        shown = None
        for level, values in floors.items():
            y = lines.index(results.level(level))
            axes.plot([values["floor"]] * 2, [y - 0.42, y + 0.42], color=style.ALARM, linewidth=2.2)
            shown = values["floor"]
        if shown is not None:
            axes.axvline(shown, color=style.ALARM, linewidth=1.0, linestyle="--")
            axes.annotate(
                f"arithmetic floor of one core: {shown:.0f} ns",
                (shown, len(lines) - 0.45),
                xytext=(5, 0),
                textcoords="offset points",
                color=style.ALARM,
                fontsize=style.SMALL_SIZE,
                va="center",
            )
        axes.set_yticks(range(len(lines)), [line.method.name for line in lines])
        axes.set_ylim(len(lines) - 0.1 if shown is not None else len(lines) - 0.5, -0.6)
        least = min([line.median for line in lines] + ([shown] if shown is not None else []))
        axes.set_xlim(least / 2.0, max(line.worst for line in lines) * 8.0)
        axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: words(x)))
        axes.grid(axis="y", visible=False)
        axes.set_xlabel("time a pose: median of the rounds, thin line to the worst")
        axes.set_title("Condition number of general configurations, one core unless said")
        figure.tight_layout()
        figure.savefig(path, dpi=style.DPI)
