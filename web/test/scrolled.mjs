/**
 * What a list takes while it is scrolled: processor time a frame of the page's main thread, which runs the script, lays out and records what is
 * to be drawn; and elapsed time from frame to frame, with the drawing.
 */
export async function scrolled(page, selector, steps = 120) {
  await page.tracing.start({ categories: ["toplevel", "disabled-by-default-devtools.timeline"] });
  const { elements, frames } = await page.evaluate(async (list, steps) => {
    const sheet = document.querySelector(list);
    const frames = [];
    let last = performance.now();
    for (let i = 0; i < steps; ++i) {
      sheet.scrollTop += 400;
      await new Promise((done) => requestAnimationFrame(done));
      frames.push(performance.now() - last);
      last = performance.now();
    }
    return { elements: document.querySelectorAll("*").length, frames };
  }, selector, steps);
  const { traceEvents } = JSON.parse(Buffer.from(await page.tracing.stop()).toString());
  const threads = new Set(traceEvents.filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain").map(({ pid, tid }) => `${pid} ${tid}`));
  // A task that has begun before the trace, or ends after it, has no time of its own.
  const tasks = traceEvents.filter(({ name, ph, pid, tid, tdur }) => name === "RunTask" && ph === "X" && tdur !== undefined && threads.has(`${pid} ${tid}`));
  if (tasks.length < frames.length) throw new Error("the trace does not tell what the page did");
  const own = tasks.reduce((sum, { tdur }) => sum + tdur, 0) / 1000;
  frames.sort((a, b) => a - b);
  return { elements, own: own / frames.length, median: frames[steps >> 1], worst: frames[steps - 2] };
}
