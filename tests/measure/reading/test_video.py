"""Positions by frame: ImageJ, MTrack2, TrackMate, bare columns; frame rate and scale."""

import numpy as np
import pytest

from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import analyse
from stackbounce.plots.measurements.track import draw

FRAMES = np.arange(120)
FALL = 0.3  # px/frame²
KEPT = 0.6
IMPACT = 41.3  # frame
SPEED = FALL * IMPACT
BACK = np.maximum(FRAMES - IMPACT, 0.0)
FALLEN = 0.5 * FALL * np.minimum(FRAMES, IMPACT) ** 2
DOWN = 100.0 + FALLEN - KEPT * SPEED * BACK + 0.5 * FALL * BACK**2  # px from the upper edge
RISES = FRAMES < IMPACT + KEPT * 2 * SPEED / FALL  # before the second bounce
FRAMES, DOWN = FRAMES[RISES], DOWN[RISES]
NOISE = np.random.default_rng(3).normal(0.0, 0.05, (2, len(FRAMES)))
X, Y = 200.0 + 0.2 * FRAMES + NOISE[0], DOWN + NOISE[1]


def rows(form):
    """Return a line for each frame k, the n-th, with its position x, y."""
    return "".join(
        form.format(k=k, n=k + 1, x=x, y=y) + "\n" for k, x, y in zip(FRAMES, X, Y, strict=True)
    )


def imagej(slices=True, delimiter=","):
    names = [" ", "Area", "Mean", "X", "Y", *["Slice"] * slices]
    cells = ["{n}", "12", "0", "{x:.4f}", "{y:.4f}", *["{n}"] * slices]
    return f"{delimiter.join(names)}\n{rows(delimiter.join(cells))}"


def mtrack2(between="\t", flag=" "):
    head = between.join(["Frame", "X1", "Y1", "Flag1"]) + "\nTracks 1 to 1\n"
    own = rows(between.join(["{n}", "{x:.4f}", "{y:.4f}", flag]))
    return f"{head}{own}\nTrack \tLength\tDistance traveled\tNr of Frames\n1\t99.0\t88.0\t77\n"


def bounces(data):
    (found,) = analyse(data)
    (ball,) = found.balls
    assert abs(ball.restitutions[0].nominal_value - KEPT) < 0.01
    assert abs(ball.gravity.nominal_value / FALL - 1.0) < 0.02
    return found


@pytest.mark.parametrize(
    "content",
    [
        imagej(),
        imagej(delimiter="\t"),
        imagej(slices=False),
        imagej().replace("X,Y", "XM,YM"),
        imagej().replace("Mean", "Label").replace(",0,", ",clip:0001,"),
        mtrack2(),
        mtrack2(",", ""),
        mtrack2(" ", ""),
        mtrack2().partition("Tracks 1 to 1\n")[2].partition("\nTrack")[0],
        "Frame,X,Y\n" + rows("{k},{x:.4f},{y:.4f}"),
        "x,y\n" + rows("{x:.4f},{y:.4f}"),
    ],
    ids=["csv", "tabs", "by row", "centres of mass", "labels", "MTrack2", "MTrack2 with commas",
         "MTrack2 with blanks", "no header", "frame x y", "x y"],
)  # fmt: skip
def test_positions_by_frame_are_a_track_in_pixels(read, content):
    data = read(content)
    assert data.attrs["holds"] == "track"
    assert (data.time.attrs["units"], data.y.attrs["units"]) == ("frame", "px")
    assert data.sizes["time"] == len(FRAMES)
    np.testing.assert_allclose(np.diff(data.time.values), 1.0)
    assert "a frame is the unit of time" in data.attrs["doubt"]
    assert "taken as pixels" in data.attrs["doubt"]
    found = bounces(data)
    assert {row.unit for row in found.rows()} == {"px", "px/frame", "", "frame", "px/frame^2"}
    assert found.axis == "-y"
    assert "restitutions do not depend on frame rate and scale" in " ".join(found.notes)
    assert "impact_speed" not in found.parts() | found.law_arguments()
    assert found.first_touch() is None


def test_frame_rate_and_scale_give_seconds_and_metres(read):
    rate = 200.0
    scale = 9.80665 / (FALL * rate**2)
    data = read(mtrack2(), frame_rate=rate, scale=scale)
    assert data.attrs["doubt"] == ""
    assert (data.time.attrs["units"], data.y.attrs["units"]) == ("s", "m")
    found = analyse(data)[0]
    assert found.time_base.agrees
    assert {row.unit for row in found.rows()} == {"m", "m/s", "", "s", "m/s^2"}
    assert abs(found.balls[0].impact_speeds[0].nominal_value / (SPEED * scale * rate) - 1) < 0.01


def test_the_fall_tells_the_scale_where_the_frame_rate_is_known(read):
    found = analyse(read(imagej(), frame_rate=200))[0]
    assert {row.unit for row in found.rows()} == {"px", "px/s", "", "s", "px/s^2"}
    told = next(note for note in found.notes if "the scale is" in note)
    scale = float(told.partition("the scale is ")[2].split()[0])
    assert abs(scale / (9.80665 / (FALL * 200**2)) - 1.0) < 0.02


def test_the_picture_has_the_units_of_the_track(read):
    data = read(imagej())
    above, below = draw(data, analyse(data)[0]).axes
    assert (above.get_ylabel(), below.get_ylabel()) == ("height (px)", "residual (px)")
    assert below.get_xlabel() == "time (frame)"


def test_wrong_frame_rates_and_scales_are_refused(read):
    words = "frame_rate must be a positive number of frames per second"
    with pytest.raises(InvalidValue, match=words):
        read(imagej(), frame_rate=0)
    with pytest.raises(InvalidType, match="scale must be a positive number of metres per pixel"):
        read(imagej(), scale="big")


FRAMED = rows("{k},{x:.3f},{y:.3f}")


@pytest.mark.parametrize(
    ("head", "names"),
    [
        ("Frame No.,px,py\n", {"Frame No.": "time", "py": "y"}),
        ("", {1: "time", 2: "x", 3: "y"}),
        ("a,b,c\n", {1: "x", 2: "z", 3: "y"}),  # its rows are frames
    ],
)
def test_a_frame_rate_makes_times_of_frames_whatever_they_are_called(read, head, names):
    data = read(head + FRAMED, names=names, frame_rate=60.0)
    assert np.diff(data.time) == pytest.approx(1 / 60)
    assert "is not used" not in data.attrs["doubt"]


@pytest.mark.parametrize("name", ["timestamp_ms", "Timestamp [ms]", "timestamp", "Time (ms)"])
def test_times_beside_a_count_of_rows_are_no_results_of_imagej(read, name):
    data = read(f",{name},x,y\n" + rows("{n},{k}0,{x},{y}"), frame_rate=60.0)
    assert np.diff(data.time) == pytest.approx(0.01)
    assert "frame_rate is not used" in data.attrs["doubt"]


def test_they_are_not_used_where_the_file_has_times_and_units(read):
    table = "t (s),x (cm),y (cm)\n0,1,2\n0.1,2,3\n0.2,3,4\n"
    data = read(table, frame_rate=100, scale=2.0)
    assert data.y.values[:, 0].tolist() == [0.02, 0.03, 0.04]
    assert "frame_rate is not used" in data.attrs["doubt"]
    assert "scale is not used" in data.attrs["doubt"]
    assert read(table.replace(" (cm)", ""), scale=0.5).y.values[:, 0].tolist() == [1.0, 1.5, 2.0]


def test_of_several_points_in_a_frame_the_next_one_is_taken(read):
    lines = imagej().splitlines()
    speck = lines[30].split(",")
    lines.insert(30, ",".join([*speck[:3], "600.0", "20.0", speck[5]]))
    data = read("\n".join(lines))
    assert data.sizes["time"] == len(FRAMES)
    assert "1 rows are further points in a frame" in data.attrs["doubt"]
    bounces(data)


HEADER = (
    "LABEL,ID,TRACK_ID,QUALITY,POSITION_X,POSITION_Y,POSITION_Z,POSITION_T,FRAME\n"
    "Label,Spot ID,Track ID,Quality,X,Y,Z,T,Frame\nLabel,Spot ID,Track ID,Quality,X,Y,Z,T,Frame\n"
)
IN_PIXELS = f"{HEADER},,,(quality),(pixel),(pixel),(pixel),(frame),\n"


def spots(track, time=1.0, shift=0.0, order=1):
    lines = [
        f"ID{k},{k},{track},1.0,{x + shift:.4f},{y:.4f},0.0,{time * k},{k}\n"
        for k, x, y in zip(FRAMES, X, Y, strict=True)
    ]
    return "".join(lines[::order])


def test_trackmate_puts_tracks_side_by_side(read):
    speck = "ID9,9,,1.0,5.0,5.0,0.0,7,7\n"  # of no track
    data = read(IN_PIXELS + spots(3) + speck + spots(5, shift=50.0, order=-1))
    assert data.attrs["format"] == "TrackMate"
    assert data.track.values.tolist() == ["track 3", "track 5"]
    np.testing.assert_allclose(data.y.values, np.stack([Y, Y], axis=1), atol=1e-4)
    np.testing.assert_allclose(data.x.values[:, 1] - data.x.values[:, 0], 50.0)
    assert (data.time.attrs["units"], data.y.attrs["units"]) == ("frame", "px")


def test_trackmate_with_calibrated_units(read):
    units = ",,,(quality),(micron),(micron),(micron),(sec),\n"
    data = read(HEADER + units + spots(0, time=0.01))
    np.testing.assert_allclose(data.time.values, 0.01 * FRAMES)
    np.testing.assert_allclose(data.y.values[:, 0], 1e-6 * Y, atol=1e-9)
    assert data.attrs["doubt"] == ""


def test_only_the_longest_tracks_are_read(read):
    short = "".join(f"ID{k},{k},{k},1,1,1,0,{k % 7},{k % 7}\n" for k in range(100, 120))
    data = read(IN_PIXELS + spots(3) + short)
    assert data.sizes["track"] == 12
    assert "track 3" in data.track.values
    assert "9 shorter tracks are left out" in data.attrs["doubt"]


def test_points_whose_blank_cells_were_lost_are_put_together(read):
    """A spreadsheet that closes up blank flags moves the points of other tracks to the left."""
    lines = ["Frame X1 Y1 Flag1 X2 Y2 Flag2", "Tracks 1 to 2" + " " * 3]
    for k, (x, y) in enumerate(zip(X, Y, strict=True)):
        ball, speck = f"{x:.3f} {y:.3f}", f"{9 + k % 2}.0 {500 + k % 3}.0"
        points = [ball, speck] if k % 3 == 0 else [speck] if k % 20 == 1 else [speck, ball]
        lines.append(f"{k + 1} {' '.join(points)}  ")
    lines += ["Track 414.8 1.03 traveled Nr of Frames", "1 74.8 17.2 131"]
    data = read("\n".join(lines))
    assert "blank cells were lost" in data.attrs["doubt"]
    assert data.track.values.tolist() == ["track 1"]  # the speck does not move
    seen = np.isfinite(data.y.values[:, 0])
    assert (~seen).sum() == sum(k % 20 == 1 and k % 3 != 0 for k in range(len(Y)))
    np.testing.assert_allclose(data.y.values[seen, 0], Y[seen], atol=1e-3)
    bounces(data)


def test_a_point_without_a_coordinate_is_left_out_and_a_falling_ball_followed_far(read):
    """A ball may be further from its last place than a point may be from a path."""
    fallen = 5.0 * np.arange(15.0) ** 2
    points = "".join(f"{k} 10.0 {y} 5.0\n" for k, y in enumerate(fallen))
    data = read("Frame X1 Y1 Flag1 X2 Y2 Flag2\n" + "0 1.0 2.0 5.0 *\n" * 3 + points)
    assert "blank cells were lost" in data.attrs["doubt"]
    assert data.track.values.tolist() == ["track 1"]
    np.testing.assert_allclose(data.y.values[-15:, 0], fallen)


def test_manual_tracking(read):
    head = "\tTrack n°\tSlice n°\tX\tY\tDistance\tVelocity\tPixel Value\n"
    data = read(head + rows("{n}\t1\t{n}\t{x:.0f}\t{y:.0f}\t-1\t-1\t0"))
    assert data.track.values.tolist() == ["track 1"]
    np.testing.assert_allclose(data.y.values[:, 0], np.round(Y))
