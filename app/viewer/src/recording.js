// Film of a scene, if the browser can record one.

const FRAMES = 30;          // per second
const CHUNK_MS = 250;       // between two parts of a recording
const FIRST_PART_MS = 4000; // a browser that has given nothing after this time gives nothing at all

export function canRecord(canvas) {
  return typeof MediaRecorder === "function" && typeof canvas.captureStream === "function";
}

/** Starts a recording. The scene is drawn without pause, because a canvas at rest gives no frames.
 *  @returns stop(), whose promise gives the film (webm), or null if the browser recorded nothing */
function record(scene) {
  const type = ["video/webm;codecs=vp9", "video/webm"].find((each) => MediaRecorder.isTypeSupported(each));
  const stream = scene.canvas.captureStream(FRAMES), recorder = new MediaRecorder(stream, {mimeType: type, videoBitsPerSecond: 6e6}), parts = [];
  const hasPart = new Promise((resolve) => recorder.addEventListener("dataavailable", ({data}) => data.size > 0 && resolve(parts.push(data))));
  const ended = new Promise((resolve) => recorder.addEventListener("stop", resolve, {once: true}));
  scene.setOpaque(true);
  const timer = setInterval(() => scene.redraw(), 1000 / FRAMES);
  recorder.start(CHUNK_MS);
  return async () => {
    await Promise.race([hasPart, new Promise((resolve) => setTimeout(resolve, FIRST_PART_MS))]);
    clearInterval(timer);
    if (recorder.state !== "inactive") recorder.stop(), await ended;
    stream.getTracks().forEach((track) => track.stop());
    scene.setOpaque(false);
    return parts.length ? new Blob(parts, {type: "video/webm"}) : null;
  };
}

/** Makes a button start and stop a film, which is then saved. @param scene returns the scene   @param name returns the
 *  name of the file   @param failed called if the browser recorded nothing */
export function listenForFilm(button, scene, name, failed) {
  let stop = null, isSaving = false;
  const show = (text) => {
    button.textContent = text;
    button.setAttribute("aria-pressed", String(Boolean(stop)));
  };
  button.addEventListener("click", async () => {
    if (isSaving) return;
    if (!stop) {
      stop = record(scene());
      return show("Stop film");
    }
    isSaving = true;
    const film = await stop();
    isSaving = false;
    stop = null;
    show("Start film");
    if (film) saveAs(film, `${name()}.webm`);
    else failed("This browser recorded no film. Try another browser.");
  });
  show("Start film");
}

export function saveAs(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
