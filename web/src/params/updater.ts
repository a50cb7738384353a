// Edits on their way to the server: one per field at a time, the newest value after it, so that a slider that is
// dragged neither floods the server nor jumps back to values it has left behind.

import type { Edit } from "./update";

export class Updater {
  private readonly underWay = new Map<number, string>();
  private readonly next = new Map<string, Edit>();

  /**
   * `send` returns the sequence number of the message, 0 where nothing is connected. `onSettled` is called when the
   * last edit of a field has been answered; `error` is the server's word where it was refused.
   */
  constructor(
    private readonly send: (edit: Edit) => number,
    private readonly onSettled: (path: string, error: string | undefined) => void,
  ) {}

  submit(edit: Edit): void {
    if (this.isBusy(edit.path)) {
      this.next.set(edit.path, edit);
      return;
    }
    const sequence = this.send(edit);
    if (sequence === 0) this.onSettled(edit.path, "Not connected");
    else this.underWay.set(sequence, edit.path);
  }

  isBusy(path: string): boolean {
    return [...this.underWay.values()].includes(path);
  }

  /** The server's answer. False where it answers something else than an edit. */
  answered(sequence: number, error?: string): boolean {
    const path = this.underWay.get(sequence);
    if (path === undefined) return false;
    this.underWay.delete(sequence);
    const newer = this.next.get(path);
    this.next.delete(path);
    if (newer) this.submit(newer);
    else this.onSettled(path, error);
    return true;
  }

  /** The connection is lost, and with it every answer. */
  forget(): void {
    const paths = new Set(this.underWay.values());
    this.underWay.clear();
    this.next.clear();
    for (const path of paths) this.onSettled(path, undefined);
  }
}
